// Draws an exported scene with Filament, its shadow code unmodified: a white scene is drawn twice, with the light casting
// shadows and not, into floats; what is written is the quotient. Its one light is direct, so that highlights cancel, too.
import { coneFrom, hardLight, readMeshes, visibilityOf } from "../browser/exported_scene.js";
import { assetOf } from "./scene_asset.js";

let engine, loader, renderer, swapChain, gl, settings, exported, meshes, colour, target;

const types = ["pcf", "vsm", "dpcf", "pcss"]; // in the order of View::ShadowType

/// The npm package lacks `View.setShadowType`. What that sets stands in the view's memory just before the options of VSM and of
/// soft shadows, whose defaults are found here.
function setShadowType(view) {
    const options = new Uint8Array(20);
    options[2] = 1; // VsmShadowOptions: anisotropy, mipmapping, msaaSamples, highPrecision;
    new Float32Array(options.buffer, 4).set([0.5, 0.15, 1, 1]); // its minVarianceScale and lightBleedReduction; SoftShadowOptions
    const begin = view.$$.ptr;
    const places = Array.from({ length: 1024 }, (_, word) => begin + 4 * word)
        .filter((place) => options.every((byte, i) => Filament.HEAPU8[place + i] === byte));
    if (places.length !== 1) throw new Error("this release of Filament keeps its shadow options elsewhere");
    Filament.HEAPU8[places[0] - 4] = types.indexOf(settings.type);
}

function addLight(frame, scene) {
    const { direction, centre } = hardLight(frame.light);
    const entity = Filament.EntityManager.get().create();
    const kind = Filament.LightManager$Type[direction ? "DIRECTIONAL" : "POINT"];
    const light = Filament.LightManager.Builder(kind).intensity(100000).castShadows(true);
    if (direction) light.direction(direction);
    // Where the range ends just behind the farthest vertex, the engine leaves whole bands of the picture dark there.
    else light.position(centre).falloff(2 * coneFrom(meshes, frame, centre).far);
    light.build(engine, entity);
    scene.addEntity(entity);
    return entity;
}

function makeCamera({ camera, view, projection }) {
    const made = engine.createCamera(Filament.EntityManager.get().create());
    made.setCustomProjection(projection, camera.near, camera.far);
    made.lookAt(camera.eye, camera.target, camera.up);
    return made;
}

async function loadFrame(frame) {
    const asset = loader.createAsset(assetOf(meshes, frame));
    await new Promise((done) => asset.loadResources(done));
    return asset;
}

/// The engine skips a frame while the last is being drawn, which it learns between two tasks of the page.
async function draw(view) {
    while (!renderer.beginFrame(swapChain)) {
        engine.execute();
        await new Promise((later) => setTimeout(later));
    }
    renderer.renderView(view);
    renderer.endFrame();
    engine.execute();
    const [width, height] = exported.scene.size;
    const pixels = new Float32Array(4 * width * height);
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colour, 0);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    gl.deleteFramebuffer(framebuffer);
    return pixels;
}

globalThis.renderFrame = async (index) => {
    const frame = exported.scene.frames.find((other) => other.index === index);
    const scene = engine.createScene(), view = engine.createView();
    const asset = await loadFrame(frame);
    scene.addEntities(asset.getEntities());
    const light = addLight(frame, scene);
    view.setScene(scene);
    view.setCamera(makeCamera(frame));
    view.setViewport([0, 0, ...exported.scene.size]);
    view.setPostProcessingEnabled(false);
    view.setRenderTarget(target);
    setShadowType(view);
    const lit = await draw(view);
    const lights = engine.getLightManager();
    lights.setShadowCaster(lights.getInstance(light), false);
    const unshadowed = await draw(view);
    engine.destroyView(view);
    engine.destroyScene(scene);
    engine.destroyEntity(light);
    loader.destroyAsset(asset);
    return visibilityOf(lit, unshadowed);
};

function makeTarget([width, height]) {
    const texture = (format, usage) => Filament.Texture.Builder().width(width).height(height).levels(1).format(format)
        .usage(usage.value | Filament.Texture$Usage.SAMPLEABLE.value).build(engine);
    const store = gl.texStorage2D.bind(gl);
    gl.texStorage2D = (...parameters) => {
        store(...parameters);
        if (parameters[2] === gl.RGBA32F) colour = gl.getParameter(gl.TEXTURE_BINDING_2D);
    };
    const builder = Filament.RenderTarget.Builder()
        .texture(Filament.RenderTarget$AttachmentPoint.COLOR,
                 texture(Filament.Texture$InternalFormat.RGBA32F, Filament.Texture$Usage.COLOR_ATTACHMENT))
        .texture(Filament.RenderTarget$AttachmentPoint.DEPTH,
                 texture(Filament.Texture$InternalFormat.DEPTH32F, Filament.Texture$Usage.DEPTH_ATTACHMENT));
    target = builder.build(engine);
    engine.execute();
}

globalThis.start = async (input, chosen) => {
    [exported, settings] = [input, chosen];
    await new Promise((ready) => Filament.init([], ready));
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = exported.scene.size;
    engine = Filament.Engine.create(canvas);
    gl = canvas.getContext("webgl2");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("refused: this WebGL cannot draw into floats");
    renderer = engine.createRenderer();
    renderer.setClearOptions({ clearColor: [0, 0, 0, 0], clear: true });
    swapChain = engine.createSwapChain();
    loader = engine.createAssetLoader();
    meshes = readMeshes(exported);
    makeTarget(exported.scene.size);
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return `Filament 1.53.4, ${gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}`;
};
