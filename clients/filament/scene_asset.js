// A frame as binary glTF, for Filament's own loader: its npm package has materials for glTF only. White, wholly rough and not
// metallic; flat triangles; an instance is a node.

const glbMagic = 0x46546c67, jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942;

function padded(bytes, filler) {
    const whole = new Uint8Array(4 * Math.ceil(bytes.length / 4)).fill(filler);
    whole.set(bytes);
    return whole;
}

function glbOf(gltf, binary) {
    const chunks = [[jsonChunk, padded(new TextEncoder().encode(JSON.stringify(gltf)), 0x20)], [binaryChunk, padded(binary, 0)]];
    const length = 12 + chunks.reduce((sum, [, bytes]) => sum + 8 + bytes.length, 0);
    const file = new Uint8Array(length), view = new DataView(file.buffer);
    [glbMagic, 2, length].forEach((number, i) => view.setUint32(4 * i, number, true));
    let at = 12;
    for (const [kind, bytes] of chunks) {
        view.setUint32(at, bytes.length, true);
        view.setUint32(at + 4, kind, true);
        file.set(bytes, at + 8);
        at += 8 + bytes.length;
    }
    return file;
}

function boundsOf(positions) {
    const column = (k) => positions.filter((_, i) => i % 3 === k);
    const all = (pick) => [0, 1, 2].map((k) => column(k).reduce((a, b) => pick(a, b)));
    return { min: all(Math.min), max: all(Math.max) };
}

/// The meshes of `readMeshes` and the nodes of a frame.
export function assetOf(meshes, frame) {
    const gltf = { asset: { version: "2.0" }, scene: 0, buffers: [], bufferViews: [], accessors: [], meshes: [], nodes: [],
                   materials: [false, true].map((doubleSided) => ({
                       doubleSided, pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1 } })) };
    const parts = [];
    let byteOffset = 0;
    const addAccessor = (array, description) => {
        gltf.bufferViews.push({ buffer: 0, byteOffset, byteLength: array.byteLength });
        gltf.accessors.push({ bufferView: gltf.bufferViews.length - 1, ...description });
        parts.push(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
        byteOffset += array.byteLength;
        return gltf.accessors.length - 1;
    };
    const vectors = (array) => ({ componentType: 5126, type: "VEC3", count: array.length / 3 });
    const numbers = new Map([...meshes.keys()].map((name, number) => [name, number]));
    for (const { positions, normals, doubleSided } of meshes.values()) {
        const indices = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
        gltf.meshes.push({ primitives: [{
            attributes: { POSITION: addAccessor(positions, { ...vectors(positions), ...boundsOf(positions) }),
                          NORMAL: addAccessor(normals, vectors(normals)) },
            indices: addAccessor(indices, { componentType: 5125, type: "SCALAR", count: indices.length }),
            material: Number(doubleSided) }] });
    }
    gltf.nodes = frame.nodes.map(({ name, mesh, matrix }) => ({ name, mesh: numbers.get(mesh), matrix }));
    gltf.scenes = [{ nodes: gltf.nodes.map((_, i) => i) }];
    gltf.buffers = [{ byteLength: byteOffset }];
    const binary = new Uint8Array(byteOffset);
    let at = 0;
    for (const part of parts) {
        binary.set(part, at);
        at += part.length;
    }
    return glbOf(gltf, binary);
}
