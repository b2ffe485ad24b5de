// Draws an exported scene with Babylon.js, its shadow code unmodified: a white diffuse scene is drawn twice, with and without
// `receiveShadows`, into floats; what is written is the quotient.
import { coneFrom, hardLight, middleOf, readMeshes, requireOneMap, visibilityOf } from "../browser/exported_scene.js";

const filters = {
    none: () => {},
    poisson: (generator) => { generator.usePoissonSampling = true; },
    pcf: (generator) => { generator.usePercentageCloserFiltering = true; },
    pcss: (generator) => { generator.useContactHardeningShadow = true; },
    esm: (generator) => { generator.useExponentialShadowMap = true; },
    "blur-esm": (generator) => { generator.useBlurExponentialShadowMap = true; },
    "close-esm": (generator) => { generator.useCloseExponentialShadowMap = true; },
};
// What the engine replaces by another filter when the map is a cube (ShadowGenerator.filter).
const notOnCubes = ["pcf", "pcss", "blur-esm"];

let engine, settings, exported, meshes;

// The engine's own coordinates are left-handed. As its glTF loader does, z is mirrored here: the world becomes M · world with
// M = diag(1, 1, −1, 1), eye space likewise: a node's matrix becomes M · matrix, the view M · view · M, the projection
// projection · M.
const vector = ([x, y, z]) => new BABYLON.Vector3(x, y, -z);
const mirrorRow = (matrix) => matrix.map((number, i) => (i % 4 === 2 ? -number : number));
const mirrorColumn = (matrix) => matrix.map((number, i) => (i >> 2 === 2 ? -number : number));
const matrixOf = (numbers) => BABYLON.Matrix.FromArray(numbers);

class ExportedCamera extends BABYLON.Camera {
    constructor(frame, scene) {
        super("camera", vector(frame.camera.eye), scene);
        this.exportedView = matrixOf(mirrorRow(mirrorColumn(frame.view)));
        [this.minZ, this.maxZ] = [frame.camera.near, frame.camera.far];
        this.freezeProjectionMatrix(matrixOf(mirrorColumn(frame.projection)));
    }
    _getViewMatrix() {
        return this.exportedView;
    }
}

const modes = { repeat: "WRAP_ADDRESSMODE", mirror: "MIRROR_ADDRESSMODE", clamp: "CLAMP_ADDRESSMODE" };

/// The engine's shadow generator takes the alpha test of a mesh's material over.
function addMask(material, { png, cutoff, nearest, wrap }, scene) {
    const filter = nearest ? BABYLON.Texture.NEAREST_SAMPLINGMODE : BABYLON.Texture.BILINEAR_SAMPLINGMODE;
    const texture = new BABYLON.Texture(`data:image/png;base64,${png}`, scene,
                                        { noMipmap: true, invertY: false, samplingMode: filter });
    texture.hasAlpha = true;
    [texture.wrapU, texture.wrapV] = wrap.map((name) => BABYLON.Texture[modes[name]]);
    material.diffuseTexture = texture;
    material.useAlphaFromDiffuseTexture = true; // of which the image's pass tests it
    material.transparencyMode = BABYLON.Material.MATERIAL_ALPHATEST;
    material.alphaCutOff = cutoff;
}

function makeMaterial(scene, { doubleSided, mask }) {
    const material = new BABYLON.StandardMaterial("white", scene);
    material.specularColor = BABYLON.Color3.Black();
    material.sideOrientation = BABYLON.Material.ClockWiseSideOrientation; // as the engine's glTF loader has it
    material.backFaceCulling = !doubleSided;
    material.twoSidedLighting = doubleSided;
    if (mask) addMask(material, mask, scene);
    return material;
}

function makeGeometry(name, { positions, normals, uv }, scene) {
    const data = new BABYLON.VertexData();
    data.positions = positions;
    data.normals = normals;
    if (uv) data.uvs = uv;
    data.indices = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
    return new BABYLON.Geometry(name, scene, data);
}

function addNodes(frame, scene) {
    const materials = new Map([...meshes].map(([name, mesh]) => [name, makeMaterial(scene, mesh)]));
    const geometries = new Map([...meshes].map(([name, mesh]) => [name, makeGeometry(name, mesh, scene)]));
    return frame.nodes.map(({ name, mesh, matrix }) => {
        const drawn = new BABYLON.Mesh(name, scene);
        geometries.get(mesh).applyToMesh(drawn);
        drawn.material = materials.get(mesh);
        drawn.rotationQuaternion = new BABYLON.Quaternion();
        matrixOf(mirrorRow(matrix)).decompose(drawn.scaling, drawn.rotationQuaternion, drawn.position);
        drawn.computeWorldMatrix(true);
        return drawn;
    });
}

/// Directional: as the manual advises, the engine fits the map's sides and depths to the casters from a position before them.
function makeDirectional(frame, direction, scene) {
    const light = new BABYLON.DirectionalLight("light", vector(direction), scene);
    const { middle, radius } = middleOf(meshes, frame);
    light.position = vector(middle).subtract(vector(direction).scale(radius + 1));
    light.autoCalcShadowZBounds = true;
    return light;
}

/// Point: a cube map; or, where the manual says "like an unlimited spot light", one map around all vertices.
function makePoint(frame, centre, scene) {
    const light = new BABYLON.PointLight("light", vector(centre), scene);
    const cone = coneFrom(meshes, frame, centre);
    const isCube = settings.map === "cube" || (settings.map === "auto" && !notOnCubes.includes(settings.filter));
    if (isCube && notOnCubes.includes(settings.filter))
        throw new Error(`refused: Babylon.js has no ${settings.filter} on cube maps; give --map single`);
    if (settings.depths === "scene") {
        light.shadowMaxZ = 1.01 * cone.far;
        const nearest = isCube ? cone.near / Math.sqrt(3) : cone.near; // of a cube's side, whose axis is another
        light.shadowMinZ = Math.max(0.99 * nearest, cone.far / 1000);
    }
    if (!isCube) {
        requireOneMap(cone, settings.filter);
        light.shadowAngle = 1.01 * 2 * cone.angle;
        light.direction = vector(cone.axis);
    }
    return light;
}

function makeGenerator(light, casters) {
    const cascaded = settings.cascades > 0;
    const Generator = cascaded ? BABYLON.CascadedShadowGenerator : BABYLON.ShadowGenerator;
    const generator = new Generator(settings["map-size"], light, settings.floats === "full");
    if (cascaded) generator.numCascades = settings.cascades;
    filters[settings.filter](generator);
    generator.bias = settings.bias;
    generator.normalBias = settings["normal-bias"];
    generator.forceBackFacesOnly = settings["back-faces"] === "yes";
    for (const caster of casters) generator.addShadowCaster(caster, false);
}

async function draw(scene, drawn, target, receiveShadows) {
    for (const mesh of drawn) mesh.receiveShadows = receiveShadows;
    await scene.whenReadyAsync();
    scene.render();
    return target.readPixels();
}

globalThis.renderFrame = async (index) => {
    const frame = exported.scene.frames.find((other) => other.index === index);
    const scene = new BABYLON.Scene(engine);
    scene.clearColor = new BABYLON.Color4(0, 0, 0, 0);
    const camera = new ExportedCamera(frame, scene);
    const [width, height] = exported.scene.size;
    const target = new BABYLON.RenderTargetTexture("image", { width, height }, scene, {
        generateMipMaps: false, type: BABYLON.Constants.TEXTURETYPE_FLOAT,
        samplingMode: BABYLON.Texture.NEAREST_SAMPLINGMODE });
    camera.outputRenderTarget = target;
    const { direction, centre } = hardLight(frame.light);
    if (settings.cascades > 0 && !direction) throw new Error("refused: cascades are for directional lights only");
    const drawn = addNodes(frame, scene);
    const light = direction ? makeDirectional(frame, direction, scene) : makePoint(frame, centre, scene);
    light.specular = BABYLON.Color3.Black();
    makeGenerator(light, drawn);
    const lit = await draw(scene, drawn, target, true);
    const unshadowed = await draw(scene, drawn, target, false);
    scene.dispose();
    return visibilityOf(lit, unshadowed);
};

globalThis.start = async (input, chosen) => {
    [exported, settings] = [input, chosen];
    if (settings.cascades === 1) throw new Error("refused: --cascades 1: the engine has 2 to 4, and 0 is one plain map");
    engine = new BABYLON.Engine(document.createElement("canvas"), false);
    if (!engine.getCaps().textureFloatRender) throw new Error("refused: this WebGL cannot draw into floats");
    meshes = readMeshes(exported);
    return `Babylon.js ${BABYLON.Engine.Version}, ${engine.getGlInfo().renderer}`;
};
