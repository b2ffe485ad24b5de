// Draws an exported scene with PlayCanvas, its shadow code unmodified: a white diffuse scene is drawn twice, with and without
// `receiveShadows`, into floats; what is written is the quotient.
import * as pc from "./node_modules/playcanvas/build/playcanvas.mjs";
import { coneFrom, depthOf, hardLight, imageOf, readMeshes, requireOneMap, visibilityOf } from "../browser/exported_scene.js";

const types = { pcf1: pc.SHADOW_PCF1_32F, pcf3: pc.SHADOW_PCF3_32F, pcf5: pc.SHADOW_PCF5_32F, vsm16: pc.SHADOW_VSM_16F,
                vsm32: pc.SHADOW_VSM_32F, pcss: pc.SHADOW_PCSS_32F };
const isVariance = () => settings.type.startsWith("vsm");

let app, settings, exported, meshes, materials, target;

const vector = (numbers) => new pc.Vec3(...numbers);

function matrixOf(numbers) {
    const matrix = new pc.Mat4();
    matrix.data.set(numbers);
    return matrix;
}

/// An entity of the engine has a position, a rotation and a scale.
function place(entity, matrix) {
    entity.setLocalPosition(matrix.getTranslation());
    entity.setLocalRotation(new pc.Quat().setFromMat4(matrix));
    entity.setLocalScale(matrix.getScale());
    const differences = entity.getWorldTransform().data.map((x, i) => Math.abs(x - matrix.data[i]));
    if (Math.max(...differences) > 1e-4) throw new Error(`refused: ${entity.name} is mirrored, which PlayCanvas lacks`);
}

function makeGeometry({ positions, normals, uv }) {
    const mesh = new pc.Mesh(app.graphicsDevice);
    mesh.setPositions(positions);
    mesh.setNormals(normals);
    if (uv) mesh.setUvs(0, uv);
    mesh.update();
    return mesh;
}

const modes = { repeat: pc.ADDRESS_REPEAT, mirror: pc.ADDRESS_MIRRORED_REPEAT, clamp: pc.ADDRESS_CLAMP_TO_EDGE };

/// The engine's shadow pass takes the alpha test of a mesh's material over.
async function addMask(material, mask) {
    const image = await imageOf(mask), filter = mask.nearest ? pc.FILTER_NEAREST : pc.FILTER_LINEAR;
    const [addressU, addressV] = mask.wrap.map((name) => modes[name]);
    const texture = new pc.Texture(app.graphicsDevice, {
        width: image.width, height: image.height, format: pc.PIXELFORMAT_RGBA8, mipmaps: false, flipY: false,
        minFilter: filter, magFilter: filter, addressU, addressV });
    texture.setSource(image);
    Object.assign(material, { opacityMap: texture, opacityMapChannel: "a", alphaTest: mask.cutoff });
}

async function makeMaterial({ doubleSided, mask }) {
    const material = new pc.StandardMaterial(); // white and without highlights, as the engine has it
    material.cull = doubleSided ? pc.CULLFACE_NONE : pc.CULLFACE_BACK;
    material.twoSidedLighting = doubleSided;
    if (mask) await addMask(material, mask);
    material.update();
    return material;
}

function addNodes(frame, root) {
    const geometries = new Map([...meshes].map(([name, mesh]) => [name, makeGeometry(mesh)]));
    return frame.nodes.map(({ name, mesh, matrix }) => {
        const entity = new pc.Entity(name);
        place(entity, matrixOf(matrix));
        const drawn = new pc.MeshInstance(geometries.get(mesh), materials.get(mesh));
        entity.addComponent("render", { meshInstances: [drawn], castShadows: true });
        root.addChild(entity);
        return entity.render;
    });
}

function addCamera({ camera, view }, root) {
    const entity = new pc.Entity("camera");
    place(entity, matrixOf(view).invert());
    entity.addComponent("camera", {
        fov: camera.fovy, aspectRatioMode: pc.ASPECT_MANUAL, aspectRatio: camera.aspect, nearClip: camera.near,
        farClip: camera.far, clearColor: new pc.Color(0, 0, 0, 0), gammaCorrection: pc.GAMMA_NONE,
        toneMapping: pc.TONEMAP_NONE, renderTarget: target });
    root.addChild(entity);
}

/// A point light whose filter the engine has for one map alone shines as a spot as wide as the frame is from there.
function shapeOf(frame, { direction, centre }) {
    if (direction) {
        const distance = settings.distance === "scene" ? { shadowDistance: 1.01 * depthOf(meshes, frame) } : {};
        return { type: "directional", numCascades: settings.cascades, ...distance };
    }
    const cone = coneFrom(meshes, frame, centre);
    const range = 1.01 * cone.far; // beyond it the engine's light does not shine
    if (!isVariance()) return { type: "omni", range };
    requireOneMap(cone, settings.type);
    const degrees = cone.angle * 180 / Math.PI;
    return { type: "spot", range, innerConeAngle: degrees, outerConeAngle: 1.01 * degrees, axis: cone.axis };
}

function addLight(frame, root) {
    const { direction, centre } = hardLight(frame.light);
    const { axis = direction, ...shape } = shapeOf(frame, { direction, centre });
    const entity = new pc.Entity("light");
    if (centre) entity.setLocalPosition(vector(centre));
    if (axis) entity.setLocalRotation(new pc.Quat().setFromDirections(pc.Vec3.DOWN, vector(axis)));
    entity.addComponent("light", {
        ...shape, castShadows: true, shadowType: types[settings.type], shadowResolution: settings["map-size"],
        shadowBias: settings.bias, normalOffsetBias: settings["normal-bias"], vsmBias: settings["vsm-bias"] });
    root.addChild(entity);
}

function draw(drawn, receiveShadows) {
    for (const mesh of drawn) mesh.receiveShadows = receiveShadows;
    app.render();
    return target.colorBuffer.read(0, 0, target.width, target.height, { renderTarget: target });
}

globalThis.renderFrame = async (index) => {
    const frame = exported.scene.frames.find((other) => other.index === index);
    const root = new pc.Entity("frame");
    app.root.addChild(root);
    const drawn = addNodes(frame, root);
    addCamera(frame, root);
    addLight(frame, root);
    const lit = await draw(drawn, true);
    const unshadowed = await draw(drawn, false);
    root.destroy();
    return visibilityOf(lit, unshadowed);
};

/// What the engine would silently replace.
function refuseOthers({ direction }) {
    if (!direction && (settings.type === "pcss" || settings.cascades > 1))
        throw new Error("refused: PlayCanvas has PCSS and cascades for directional lights only");
}

globalThis.start = async (input, chosen) => {
    [exported, settings] = [input, chosen];
    refuseOthers(hardLight(exported.scene.light));
    app = new pc.Application(document.createElement("canvas"), { graphicsDeviceOptions: { antialias: false } });
    const device = app.graphicsDevice;
    if (!device.textureFloatRenderable) throw new Error("refused: this WebGL cannot draw into floats");
    app.scene.ambientLight = new pc.Color(0, 0, 0);
    app.scene.clusteredLightingEnabled = !isVariance(); // which spots have without clusters only, says the manual
    if (settings.type.startsWith("pcf")) app.scene.lighting.shadowType = types[settings.type]; // clusters have no other
    app.scene.lighting.shadowAtlasResolution = settings["atlas-size"];
    meshes = readMeshes(exported);
    materials = new Map(await Promise.all([...meshes].map(async ([name, mesh]) => [name, await makeMaterial(mesh)])));
    const [width, height] = exported.scene.size;
    const colorBuffer = new pc.Texture(device, { width, height, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
                                                 minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
    target = new pc.RenderTarget({ colorBuffer, depth: true, samples: 1 });
    return `PlayCanvas ${pc.version}, ${device.unmaskedRenderer}`;
};
