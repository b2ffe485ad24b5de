// What pages need of an exported scene (docs/exchange.md): its meshes as flat-shaded triangles, where the vertices of a frame
// lie, and the image that is written.

const floatComponent = 5126;
const indexReaders = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };

function bytesOf(base64) {
    return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
}

function readAccessor(gltf, buffer, number) {
    const accessor = gltf.accessors[number];
    const view = gltf.bufferViews[accessor.bufferView];
    const start = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    if (accessor.componentType !== floatComponent)
        return new indexReaders[accessor.componentType](buffer.slice(start), 0, accessor.count);
    const bytes = accessor.type === "VEC2" ? 8 : 12;
    if ((view.byteStride ?? bytes) !== bytes) throw new Error("refused: vertices of the scene's glTF are interleaved");
    return new Float32Array(buffer.slice(start, start + bytes * accessor.count));
}

/// Three vertices for each triangle, with the triangle's normal.
function flatTriangles(positions, indices) {
    const flat = { positions: new Float32Array(3 * indices.length), normals: new Float32Array(3 * indices.length) };
    const vertex = (index) => positions.subarray(3 * index, 3 * index + 3);
    for (let first = 0; first < indices.length; first += 3) {
        const [a, b, c] = [0, 1, 2].map((corner) => vertex(indices[first + corner]));
        const [ab, ac] = [b, c].map((other) => [other[0] - a[0], other[1] - a[1], other[2] - a[2]]);
        const normal = [1, 2, 0].map((i, k) => ab[i] * ac[(k + 2) % 3] - ab[(k + 2) % 3] * ac[i]);
        const length = Math.hypot(...normal) || 1;
        [a, b, c].forEach((corner, k) => {
            flat.positions.set(corner, 3 * (first + k));
            flat.normals.set(normal.map((x) => x / length), 3 * (first + k));
        });
    }
    return flat;
}

const nearestFilter = 9728;
const wraps = { 33071: "clamp", 33648: "mirror" };

/// The alpha test of a material: `png` (base64), `cutoff`, whether the `nearest` texel counts, `wrap` along u and v.
function maskOf({ gltf, images }, { alphaMode, alphaCutoff, pbrMetallicRoughness }) {
    if (alphaMode !== "MASK") return undefined;
    const texture = gltf.textures[pbrMetallicRoughness.baseColorTexture.index];
    const { magFilter, wrapS, wrapT } = gltf.samplers[texture.sampler];
    return { png: images[texture.source], cutoff: alphaCutoff, nearest: magFilter === nearestFilter,
             wrap: [wrapS, wrapT].map((wrap) => wraps[wrap] ?? "repeat") };
}

/// A mask's PNG as an image whose colours stay as they are.
export function imageOf({ png }) {
    const blob = new Blob([bytesOf(png)], { type: "image/png" });
    return createImageBitmap(blob, { premultiplyAlpha: "none", colorSpaceConversion: "none" });
}

/// Meshes by name: `positions` and `normals` of unindexed triangles, whether they are seen from both sides, and of cards
/// their `mask` and places in it (`uv`, v downwards).
export function readMeshes(exported) {
    const { gltf, buffer } = exported;
    const bytes = bytesOf(buffer);
    return new Map(gltf.meshes.map((mesh) => {
        const [primitive] = mesh.primitives;
        const accessors = [primitive.attributes.POSITION, primitive.indices];
        const [positions, indices] = accessors.map((number) => readAccessor(gltf, bytes, number));
        const material = gltf.materials?.[primitive.material] ?? {};
        const triangles = { ...flatTriangles(positions, indices), doubleSided: material.doubleSided === true };
        const mask = maskOf(exported, material);
        if (!mask) return [mesh.name, triangles];
        const places = readAccessor(gltf, bytes, primitive.attributes.TEXCOORD_0);
        const uv = Float32Array.from({ length: 2 * indices.length }, (_, i) => places[2 * indices[i >> 1] + i % 2]);
        return [mesh.name, { ...triangles, mask, uv }];
    }));
}

/// Calls `visit(x, y, z)` for each vertex of a frame, in the world.
export function visitVertices(meshes, frame, visit) {
    for (const { mesh, matrix: m } of frame.nodes) {
        const { positions: p } = meshes.get(mesh);
        for (let i = 0; i < p.length; i += 3)
            visit(m[0] * p[i] + m[4] * p[i + 1] + m[8] * p[i + 2] + m[12],
                  m[1] * p[i] + m[5] * p[i + 1] + m[9] * p[i + 2] + m[13],
                  m[2] * p[i] + m[6] * p[i + 1] + m[10] * p[i + 2] + m[14]);
    }
}

/// Smallest and largest coordinates of a frame's vertices along each of `axes`.
export function boundsAlong(meshes, frame, axes) {
    const bounds = axes.map(() => ({ least: Infinity, most: -Infinity }));
    visitVertices(meshes, frame, (x, y, z) => axes.forEach((axis, k) => {
        const along = axis[0] * x + axis[1] * y + axis[2] * z;
        bounds[k].least = Math.min(bounds[k].least, along);
        bounds[k].most = Math.max(bounds[k].most, along);
    }));
    return bounds;
}

/// Middle of the box around a frame's vertices, and half of that box's diagonal.
export function middleOf(meshes, frame) {
    const bounds = boundsAlong(meshes, frame, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    return { middle: bounds.map(({ least, most }) => (least + most) / 2),
             radius: Math.hypot(...bounds.map(({ least, most }) => most - least)) / 2 };
}

/// Distance along the viewing axis of the vertex that is farthest from the camera.
export function depthOf(meshes, frame) {
    const { view } = frame; // column by column, and −z lies ahead
    const [{ least }] = boundsAlong(meshes, frame, [[view[2], view[6], view[10]]]);
    return -(least + view[14]);
}

/// The frame as seen from a point towards its middle: that `axis`, the largest angle (radians) between it and a vertex, the
/// least distance along it and the largest distance of a vertex.
export function coneFrom(meshes, frame, eye) {
    const toMiddle = middleOf(meshes, frame).middle.map((x, k) => x - eye[k]);
    const axis = toMiddle.map((x) => x / Math.hypot(...toMiddle));
    const cone = { axis, angle: 0, near: Infinity, far: 0 };
    visitVertices(meshes, frame, (...vertex) => {
        const to = vertex.map((x, k) => x - eye[k]);
        const distance = Math.hypot(...to);
        const along = to[0] * axis[0] + to[1] * axis[1] + to[2] * axis[2];
        cone.angle = Math.max(cone.angle, Math.acos(Math.min(Math.max(along / distance, -1), 1)));
        cone.near = Math.min(cone.near, along);
        cone.far = Math.max(cone.far, distance);
    });
    return cone;
}

/// Towards 180 degrees a perspective map has no texels left for what lies ahead.
export function requireOneMap({ angle }, purpose) {
    const degrees = 2 * angle * 180 / Math.PI;
    if (degrees > 170)
        throw new Error(`refused: the scene is ${degrees.toFixed(0)} degrees wide, seen from the light: too much for ` +
                        `the one map that ${purpose} needs`);
}

/// The light as an engine with hard lights has it: a direction, or the point at an area light's centre.
export function hardLight({ kind, centre, direction }) {
    if (kind === "directional") return { direction };
    if (kind === "environment") throw new Error("refused: no shadow map is of an environment light; choose another scene");
    return { centre };
}

/// Red of `lit` over red of `unshadowed` (RGBA floats), 0 where no light falls, as base64 of 32-bit floats.
export function visibilityOf(lit, unshadowed) {
    const quotient = (a, b) => (b > 0 ? a / b : 0);
    const visibility = new Float32Array(lit.length / 4).map((_, i) => quotient(lit[4 * i], unshadowed[4 * i]));
    const bytes = new Uint8Array(visibility.buffer);
    let letters = "";
    for (let i = 0; i < bytes.length; i += 8192) letters += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(letters);
}
