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

/// The meshes of a .gltf by name, each in its own space, with the vertices and triangles of the file in their order; not
/// said to be closed. Read is what any exporter may write of one triangle list a mesh: positions of 32-bit floats, indices
/// of 8, 16 or 32 bits, buffers in files beside it. A mesh that is something else is left out. Throws as above.
std::map<std::string, Mesh> importParts(const std::filesystem::path& file);

/// About `triangles` triangles of the same shape, by edge collapses at existing positions; never more than `mesh` has.
Mesh simplified(const Mesh& mesh, int triangles);

} // namespace shadowbench
