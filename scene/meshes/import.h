// Meshes from other people's files (OBJ, PLY, glTF 2.0), read in a child that can reach nothing else
// (docs/threat-model.md); and coarser ones from fine ones, through meshoptimizer.
#pragma once

#include "scene/mesh.h"

#include <filesystem>
#include <map>
#include <string>

namespace shadowbench {

/// All triangle meshes of the file in one, in the file's own units and axes, welded; not said to be closed; positions are
/// finite and indices in range. Read through assimp, by the file's extension: .obj, .ply, .gltf or .glb. A .gltf may name
/// buffers below its folder. Throws BadInput, one line with the file and the reason, when it cannot be read, holds no
/// triangle, is beyond a limit (base/limits.h), or when its reader dies or hangs.
Mesh importMesh(const std::filesystem::path& file);

/// The primitives of a .gltf or .glb by name (PartNames in scene/gltf_file.h), each in its own space and not said to be
/// closed; points and lines are left out. Of what we have exported, vertices and triangles are those of the file in their
/// order; others are welded, too. Read is what any exporter may write without extensions and sparse accessors: positions of
/// 32-bit floats; lists, strips and fans; buffers beside the file, within it or in data URIs. Throws as above.
std::map<std::string, Mesh> importParts(const std::filesystem::path& file, int maskTexels = 0);

/// `mesh` without its triangles of no area, which no image shows, and with what it says of them in `flat`. One that is said
/// to be closed is as it was: they may be what closes it; and so is one that has no others.
Mesh withoutFlat(const Mesh& mesh);

/// About `triangles` triangles of the same shape, by edge collapses at existing positions; never more than `mesh` has.
Mesh simplified(const Mesh& mesh, int triangles);

} // namespace shadowbench
