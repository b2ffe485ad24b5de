// Meshes from files, through assimp (OBJ, PLY, glTF 2.0), and coarser ones from fine ones, through meshoptimizer.
#pragma once

#include "scene/mesh.h"

#include <filesystem>

namespace shadowbench {

/// All triangle meshes of the file in one, in the file's own units and axes, welded; not said to be closed. Throws BadInput
/// naming the file and the reason when it cannot be read or holds no triangle.
Mesh importMesh(const std::filesystem::path& file);

/// About `triangles` triangles of the same shape, by edge collapses at existing positions; never more than `mesh` has.
Mesh simplified(const Mesh& mesh, int triangles);

} // namespace shadowbench
