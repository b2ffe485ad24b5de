// Draws an exported scene with three.js, its shadow code unmodified: a white diffuse scene is drawn twice, with and without
// `receiveShadow`, into floats; what is written is the quotient.
import {
    boundsAlong, coneFrom, hardLight, imageOf, middleOf, readMeshes, requireOneMap, visibilityOf,
} from "../browser/exported_scene.js";

const types = { basic: "BasicShadowMap", pcf: "PCFShadowMap", pcfsoft: "PCFSoftShadowMap", vsm: "VSMShadowMap" };

let three, renderer, settings, exported, meshes, geometries, materials, light, target;

function makeGeometry({ positions, normals, uv }) {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new three.BufferAttribute(normals, 3));
    if (uv) geometry.setAttribute("uv", new three.BufferAttribute(uv, 2));
    return geometry;
}

const wrapOf = (wrap) => ({ repeat: three.RepeatWrapping, mirror: three.MirroredRepeatWrapping,
                            clamp: three.ClampToEdgeWrapping })[wrap];

/// White; the engine's shadow pass takes the alpha test of a mesh's material over.
async function makeMaterial({ doubleSided, mask }) {
    const material = new three.MeshLambertMaterial({ color: 0xffffff,
                                                     side: doubleSided ? three.DoubleSide : three.FrontSide });
    if (!mask) return material;
    const filter = mask.nearest ? three.NearestFilter : three.LinearFilter;
    const texture = new three.Texture(await imageOf(mask), three.UVMapping, ...mask.wrap.map(wrapOf), filter, filter);
    texture.flipY = texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return Object.assign(material, { map: texture, alphaTest: mask.cutoff });
}

function makeLight({ direction }) {
    const isSpot = settings.type === "vsm"; // which the engine does not have for point lights
    const kind = direction ? "DirectionalLight" : isSpot ? "SpotLight" : "PointLight";
    const made = new three[kind](0xffffff, 1);
    made.castShadow = true;
    made.shadow.mapSize.set(settings["map-size"], settings["map-size"]);
    made.shadow.bias = settings.bias;
    made.shadow.normalBias = settings["normal-bias"];
    made.shadow.radius = settings.radius;
    return made;
}

/// The shadow camera of a directional light is a box of fixed size: here it is the smallest around the frame's vertices.
function fitDirectional(frame, { direction }) {
    const { middle, radius } = middleOf(meshes, frame);
    const centre = new three.Vector3(...middle);
    light.position.copy(centre).addScaledVector(new three.Vector3(...direction), -(radius + 1));
    light.target.position.copy(centre);
    const axes = [new three.Vector3(), new three.Vector3(), new three.Vector3()];
    new three.Matrix4().lookAt(light.position, centre, light.shadow.camera.up).extractBasis(...axes);
    const [x, y, z] = boundsAlong(meshes, frame, axes.map((axis) => axis.toArray()));
    const [cx, cy, cz] = axes.map((axis) => axis.dot(light.position));
    Object.assign(light.shadow.camera, { left: x.least - cx, right: x.most - cx, bottom: y.least - cy, top: y.most - cy,
                                         near: cz - z.most - 0.01, far: cz - z.least + 0.01 });
    light.shadow.camera.updateProjectionMatrix();
}

/// A spot light is as wide as the frame is from there.
function fitSpot(frame, { centre }) {
    const cone = coneFrom(meshes, frame, centre);
    requireOneMap(cone, settings.type);
    light.angle = 1.01 * cone.angle;
    light.position.set(...centre);
    light.target.position.set(...centre.map((x, k) => x + cone.axis[k]));
}

function makeScene(frame) {
    const scene = new three.Scene();
    for (const { mesh, matrix } of frame.nodes) {
        const drawn = new three.Mesh(geometries.get(mesh), materials.get(mesh));
        drawn.matrixAutoUpdate = false;
        drawn.matrix.fromArray(matrix);
        drawn.matrixWorldNeedsUpdate = true;
        drawn.castShadow = true;
        scene.add(drawn);
    }
    const description = hardLight(frame.light);
    if (light.isDirectionalLight) fitDirectional(frame, description);
    else if (light.isSpotLight) fitSpot(frame, description);
    else light.position.set(...description.centre);
    scene.add(light);
    if (light.target) scene.add(light.target);
    return scene;
}

function makeCamera({ view, projection }) {
    const camera = new three.PerspectiveCamera();
    camera.matrixAutoUpdate = false;
    camera.matrix.fromArray(view).invert();
    camera.matrixWorldNeedsUpdate = true;
    camera.projectionMatrix.fromArray(projection);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    return camera;
}

function draw(scene, camera, receiveShadow) {
    scene.traverse((object) => { if (object.isMesh) object.receiveShadow = receiveShadow; });
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * target.width * target.height);
    renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, pixels);
    return pixels;
}

globalThis.renderFrame = (index) => {
    const frame = exported.scene.frames.find((other) => other.index === index);
    const scene = makeScene(frame);
    const camera = makeCamera(frame);
    return visibilityOf(draw(scene, camera, true), draw(scene, camera, false));
};

globalThis.start = async (input, chosen) => {
    [exported, settings] = [input, chosen];
    const current = settings.release === "current";
    if (current && settings.type === "pcfsoft")
        throw new Error("refused: three.js has no PCFSoftShadowMap since r182; give --release r181");
    three = await import(`./node_modules/${current ? "three" : "three-r181"}/build/three.module.js`);
    renderer = new three.WebGLRenderer({ antialias: false });
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = three[types[settings.type]];
    renderer.setClearColor(0x000000, 0);
    const gl = renderer.getContext();
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("refused: this WebGL cannot draw into floats");
    meshes = readMeshes(exported);
    geometries = new Map([...meshes].map(([name, mesh]) => [name, makeGeometry(mesh)]));
    materials = new Map(await Promise.all([...meshes].map(async ([name, mesh]) => [name, await makeMaterial(mesh)])));
    light = makeLight(hardLight(exported.scene.light));
    target = new three.WebGLRenderTarget(...exported.scene.size, { type: three.FloatType, samples: 0,
                                         minFilter: three.NearestFilter, magFilter: three.NearestFilter });
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return `three.js r${three.REVISION}, ${gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}`;
};
