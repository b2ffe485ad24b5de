// Draws an exported scene with OGL, its Shadow class unmodified. The library has neither lights nor materials: its users
// write the lookup themselves, so the shader here has that of the library's example shadow-maps.html and nothing beside it,
// and what it draws is the visibility.
import { Camera, Geometry, Mesh, Program, Renderer, RenderTarget, Shadow, Transform } from "./node_modules/ogl/src/index.js";
import {
    boundsAlong, coneFrom, hardLight, middleOf, readMeshes, requireOneMap, visibilityOf,
} from "../browser/exported_scene.js";

const vertexShader = `
attribute vec3 position;
uniform mat4 modelMatrix, modelViewMatrix, projectionMatrix, shadowViewMatrix, shadowProjectionMatrix;
varying vec4 inLight;
void main() {
    inLight = shadowProjectionMatrix * shadowViewMatrix * modelMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// Depths are unpacked as Shadow packs them.
const fragmentShader = `
precision highp float;
uniform sampler2D tShadow;
uniform float bias;
varying vec4 inLight;
void main() {
    vec3 texel = 0.5 * inLight.xyz / inLight.w + 0.5;
    float occluder = dot(texture2D(tShadow, texel.xy), 1.0 / vec4(1.0, 255.0, 65025.0, 16581375.0));
    gl_FragColor = vec4(vec3(step(texel.z - bias, occluder)), 1.0);
}`;

let gl, settings, exported, meshes, geometries, programs, shadow, target;

/// By its matrix: the engine would compose one of position, rotation and scale.
function place(object, matrix) {
    object.matrixAutoUpdate = false;
    object.matrix.copy(matrix);
    object.worldMatrixNeedsUpdate = true;
}

/// The light's camera of the example is a box fitted to its scene by hand; here it is the smallest around the frame's vertices.
function fitDirectional(frame, direction) {
    const { light } = shadow;
    const { middle, radius } = middleOf(meshes, frame);
    light.position.set(middle.map((x, k) => x - (radius + 1) * direction[k]));
    light.lookAt(middle);
    light.updateMatrixWorld();
    const axes = [0, 4, 8].map((first) => light.worldMatrix.slice(first, first + 3));
    const [x, y, z] = boundsAlong(meshes, frame, axes);
    const [cx, cy, cz] = axes.map((axis) => light.position.dot(axis));
    light.orthographic({ left: x.least - cx, right: x.most - cx, bottom: y.least - cy, top: y.most - cy,
                         near: cz - z.most - 0.01, far: cz - z.least + 0.01 });
}

/// A point light is what the example calls a spotlight, a camera in perspective: as wide as the frame is from there.
function fitSpot(frame, centre) {
    const cone = coneFrom(meshes, frame, centre);
    requireOneMap(cone, "OGL's Shadow");
    const { light } = shadow;
    light.position.set(centre);
    light.lookAt(cone.axis.map((x, k) => centre[k] + x));
    light.perspective({ fov: 2.02 * cone.angle * 180 / Math.PI, near: 0.99 * cone.near, far: 1.01 * cone.far });
}

function makeScene(frame) {
    const scene = new Transform();
    for (const { mesh, matrix } of frame.nodes) {
        const drawn = new Mesh(gl, { geometry: geometries.get(mesh), program: programs[Number(meshes.get(mesh).doubleSided)] });
        place(drawn, matrix);
        drawn.setParent(scene);
        shadow.add({ mesh: drawn });
    }
    return scene;
}

function makeCamera({ view, projection }) {
    const camera = new Camera(gl);
    place(camera, view);
    camera.matrix.inverse();
    camera.projectionMatrix.copy(projection);
    return camera;
}

globalThis.renderFrame = (index) => {
    const frame = exported.scene.frames.find((other) => other.index === index);
    const { direction, centre } = hardLight(frame.light);
    if (direction) fitDirectional(frame, direction);
    else fitSpot(frame, centre);
    const scene = makeScene(frame);
    shadow.render({ scene });
    gl.renderer.render({ scene, camera: makeCamera(frame), target });
    const pixels = new Float32Array(4 * target.width * target.height);
    gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, pixels);
    return visibilityOf(pixels, pixels.map(() => 1)); // no light is on the way that would be divided out
};

globalThis.start = (input, chosen) => {
    [exported, settings] = [input, chosen];
    gl = new Renderer().gl;
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("refused: this WebGL cannot draw into floats");
    gl.clearColor(1, 1, 1, 1); // as in the example: where nothing is in the map, nothing is in shadow
    meshes = readMeshes(exported);
    geometries = new Map([...meshes].map(([name, { positions }]) =>
        [name, new Geometry(gl, { position: { size: 3, data: positions } })]));
    programs = [gl.BACK, false].map((cullFace) => new Program(gl, {
        vertex: vertexShader, fragment: fragmentShader, cullFace, uniforms: { bias: { value: settings.bias } } }));
    shadow = new Shadow(gl, { width: settings["map-size"] });
    if (settings.filter === "nearest") {
        const { texture } = shadow.target;
        Object.assign(texture, { minFilter: gl.NEAREST, magFilter: gl.NEAREST, needsUpdate: true }).update();
    }
    const [width, height] = exported.scene.size;
    // Depths of 24 bits come with the stencil; the library's own have 16, too few for what the camera sees.
    target = new RenderTarget(gl, { width, height, stencil: true, type: gl.FLOAT, internalFormat: gl.RGBA32F,
                                    minFilter: gl.NEAREST });
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return `OGL, ${gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}`;
};
