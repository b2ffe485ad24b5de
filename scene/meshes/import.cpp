// Meshes from other people's files: the child reads them, here they are received and checked.
#include "scene/meshes/import.h"

#include "base/confined/reader.h"
#include "base/error.h"
#include "base/limits.h"
#include "scene/gltf_file.h"
#include "scene/meshes/foreign_mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestName = 4096; // of a mesh in a .gltf, bytes
constexpr std::uint64_t mostParts = 1'000'000;

/// What is asked of the child: the extension of the file, whose meshes are wanted as one; or this before it, for its parts.
constexpr std::string_view partsOf = "parts";

// ---- in the child
// ---------------------------------------------------------------------------------------------------------------

ForeignMeshFile contentsOf(const ForeignWork& work) {
    const std::string request = work.request();
    ForeignMeshFile file{
        request.starts_with(partsOf) ? request.substr(partsOf.size()) : request, contentOf(work.files().front()), {}};
    for (const OpenedFile& buffer : std::span(work.files()).subspan(1)) file.buffers.emplace(buffer.name, contentOf(buffer));
    return file;
}

void put(Wire& wire, const Mesh& mesh) {
    wire.put(std::uint64_t{mesh.positions.size()});
    wire.put(std::uint64_t{mesh.triangles.size()});
    wire.put(std::span(mesh.positions));
    wire.put(std::span(mesh.triangles));
}

void answerWithMesh(ForeignWork& work) {
    const Mesh mesh = readMeshHere(contentsOf(work));
    put(work.answer(), mesh);
}

void answerWithParts(ForeignWork& work) {
    const std::map<std::string, Mesh> parts = readPartsHere(contentsOf(work));
    Wire& wire = work.answer();
    wire.put(std::uint64_t{parts.size()});
    for (const auto& [name, mesh] : parts) {
        wire.put(std::string_view(name).substr(0, longestName));
        put(wire, mesh);
    }
}

void answer(ForeignWork& work) { work.request().starts_with(partsOf) ? answerWithParts(work) : answerWithMesh(work); }

const ForeignReader meshReader("mesh", answer);

// ---- in the parent
// --------------------------------------------------------------------------------------------------------------

std::string extensionOf(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// The file, and the buffers that a glTF file names.
std::vector<OpenedFile> filesOf(const fs::path& file, const std::string& doing) {
    std::vector<OpenedFile> files;
    files.push_back(openRegular(file));
    std::vector<std::string> names;
    try {
        const std::string extension = extensionOf(file);
        requireMeshExtension(extension);
        if (extension == ".gltf") names = filesNeededBy(contentOf(files.front()));
        if (extension == ".glb") names = filesNeededBy(glbChunks(contentOf(files.front())).json);
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("{}: {}", doing, error.what()));
    }
    for (const std::string& name : names) files.push_back(openBelow(file.parent_path(), name));
    return files;
}

/// What the child may still send of one file.
struct Room {
    std::uint64_t vertices = limitOf(Limit::Vertices), triangles = limitOf(Limit::Triangles);
};

void requireSound(const Mesh& mesh, const ReaderChild& child) {
    const auto finite = [](const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
    const auto wrong = std::ranges::find_if_not(mesh.positions, finite);
    if (wrong != mesh.positions.end())
        child.refuse(fmt::format("position {} is not finite", wrong - mesh.positions.begin()));
    for (const glm::uvec3& t : mesh.triangles)
        if (const std::uint32_t last = std::max({t.x, t.y, t.z}); last >= mesh.positions.size())
            child.refuse(fmt::format("a triangle uses position {} of {}", last, mesh.positions.size()));
}

Mesh received(ReaderChild& child, Room& room) {
    Mesh mesh;
    const std::uint64_t vertices = child.number(room.vertices, "vertices"),
                        triangles = child.number(room.triangles, "triangles");
    room.vertices -= vertices;
    room.triangles -= triangles;
    mesh.positions.resize(vertices);
    mesh.triangles.resize(triangles);
    child.fill(std::span(mesh.positions));
    child.fill(std::span(mesh.triangles));
    requireSound(mesh, child);
    return mesh;
}

} // namespace

Mesh receivedMesh(ReaderChild& child) {
    child.awaitAnswer();
    Room room;
    return received(child, room);
}

std::map<std::string, Mesh> receivedParts(ReaderChild& child) {
    child.awaitAnswer();
    Room room;
    std::map<std::string, Mesh> parts;
    for (std::uint64_t left = child.number(mostParts, "meshes"); left > 0; --left) {
        std::string name = child.text(longestName);
        parts.insert_or_assign(std::move(name), received(child, room));
    }
    return parts;
}

Mesh importMesh(const fs::path& file) {
    const std::string doing = fmt::format("cannot import mesh {}", file.string());
    ReaderChild child(meshReader, doing, filesOf(file, doing), extensionOf(file));
    return receivedMesh(child);
}

std::map<std::string, Mesh> importParts(const fs::path& file) {
    const std::string doing = fmt::format("cannot read {}", file.string());
    ReaderChild child(meshReader, doing, filesOf(file, doing), std::string(partsOf) + extensionOf(file));
    return receivedParts(child);
}

} // namespace shadowbench
