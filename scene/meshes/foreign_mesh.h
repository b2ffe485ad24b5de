// What the child does that reads a mesh (scene/meshes/import.h): other people's bytes become meshes. Nothing here protects
// the process that calls it.
#pragma once

#include "scene/mesh.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

class ReaderChild;

/// A mesh file and the files that it names, as bytes.
struct ForeignMeshFile {
    std::string extension; // ".obj", ".ply", ".gltf" or ".glb"; the importer is chosen by it alone
    std::string bytes;
    std::map<std::string, std::string> buffers; // and textures of a glTF file, by the name that it gives them
    int maskTexels = 0;                         // per side of a mask at most; 0: as its texture has
};

/// Throws BadInput, without a file's name, unless it is one of the four.
void requireMeshExtension(const std::string& extension);

/// All triangle meshes of the file in one, through assimp, welded. Throws BadInput with the reason, without a file's name.
Mesh readMeshHere(const ForeignMeshFile& file);

/// The parts of a .gltf or .glb by name (importParts()), through nlohmann's JSON. Throws as above.
std::map<std::string, Mesh> readPartsHere(const ForeignMeshFile& file);

/// The names of the files that hold a glTF file's buffers and the textures of its alpha tests, each once; `gltf` is its
/// JSON. Nothing else of the file is kept in memory. Throws BadInput for more than the child can be handed, and for JSON
/// nested deeper than Limit::Nesting; of other errors the child speaks.
std::vector<std::string> filesNeededBy(std::string_view gltf);

/// What a child has answered, checked: finite positions, indices in range, no more than Limit::Vertices and
/// Limit::Triangles. Throws BadInput.
Mesh receivedMesh(ReaderChild& child);
std::map<std::string, Mesh> receivedParts(ReaderChild& child);

/// `mesh` without the positions that no triangle uses.
Mesh compacted(const Mesh& mesh);

} // namespace shadowbench
