// Meshes from other people's files: the child reads them, here they are received and checked.
#include "scene/meshes/import.h"

#include "base/confined/reader.h"
#include "base/error.h"
#include "base/limits.h"
#include "scene/gltf_file.h"
#include "scene/masked_mesh.h"
#include "scene/meshes/foreign_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestName = 4096; // of a mesh in a .gltf, bytes
constexpr std::uint64_t mostParts = 1'000'000;
constexpr std::uint64_t withoutMask = 0; // in place of a mask's number

/// What is asked of the child: the extension of the file, whose meshes are wanted as one; or this and maskTexels before it,
/// for its parts: "parts64.glb".
constexpr std::string_view partsOf = "parts";

// ---- in the child
// ---------------------------------------------------------------------------------------------------------------

ForeignMeshFile contentsOf(const ForeignWork& work) {
    const std::string request = work.request();
    const std::size_t extension = request.find('.');
    ForeignMeshFile file{request.substr(extension), contentOf(work.files().front()), {}};
    if (request.starts_with(partsOf))
        file.maskTexels = std::stoi(request.substr(partsOf.size(), extension - partsOf.size()));
    for (const OpenedFile& buffer : std::span(work.files()).subspan(1)) file.buffers.emplace(buffer.name, contentOf(buffer));
    return file;
}

void put(Wire& wire, const Mesh& mesh) {
    wire.put(std::uint64_t{mesh.positions.size()});
    wire.put(std::uint64_t{mesh.triangles.size()});
    wire.put(std::span(mesh.positions));
    wire.put(std::span(mesh.triangles));
}

void put(Wire& wire, const AlphaMask& mask) {
    const std::array<double, 1> cutoff{mask.cutoff};
    wire.put(static_cast<std::uint64_t>(mask.alpha.width()));
    wire.put(static_cast<std::uint64_t>(mask.alpha.height()));
    wire.put(std::span<const float>(mask.alpha.data(), mask.alpha.size()));
    wire.put(std::span<const double>(cutoff));
    for (const auto number : {std::uint64_t{mask.nearest}, std::uint64_t(mask.u), std::uint64_t(mask.v)}) wire.put(number);
}

void answerWithMesh(ForeignWork& work) {
    const Mesh mesh = readMeshHere(contentsOf(work));
    put(work.answer(), mesh);
}

void answerWithParts(ForeignWork& work) {
    const std::map<std::string, Mesh> parts = readPartsHere(contentsOf(work));
    std::map<const AlphaMask*, std::uint64_t> masks; // with their numbers, from 1
    std::vector<const AlphaMask*> inOrder;
    for (const auto& [name, mesh] : parts)
        if (mesh.cards && masks.try_emplace(mesh.cards->mask.get(), masks.size() + 1).second)
            inOrder.push_back(mesh.cards->mask.get());
    Wire& wire = work.answer();
    wire.put(std::uint64_t{inOrder.size()});
    for (const AlphaMask* mask : inOrder) put(wire, *mask);
    wire.put(std::uint64_t{parts.size()});
    for (const auto& [name, mesh] : parts) {
        wire.put(std::string_view(name).substr(0, longestName));
        put(wire, mesh);
        wire.put(mesh.cards ? masks.at(mesh.cards->mask.get()) : withoutMask);
        if (!mesh.cards) continue;
        put(wire, mesh.cards->mesh);
        wire.put(std::span(mesh.cards->uv));
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
    std::uint64_t vertices = limitOf(Limit::Vertices), triangles = limitOf(Limit::Triangles),
                  pixels = limitOf(Limit::Pixels);
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

AlphaMask receivedMask(ReaderChild& child, Room& room) {
    constexpr auto lastWrap = static_cast<std::uint64_t>(AlphaMask::Wrap::Clamp);
    const std::uint64_t width = child.number(room.pixels, "columns of a mask");
    const std::uint64_t height = child.number(width > 0 ? room.pixels / width : 0, "rows of a mask");
    if (height == 0) child.refuse("a mask has no pixels");
    room.pixels -= width * height;
    AlphaMask mask{.alpha = Image<float>(static_cast<int>(width), static_cast<int>(height))};
    std::array<double, 1> cutoff{};
    child.fill(std::span<float>(mask.alpha.data(), mask.alpha.size()));
    child.fill(std::span<double>(cutoff));
    const auto isFinite = [](double value) { return std::isfinite(value); };
    if (!isFinite(cutoff[0]) || !std::ranges::all_of(mask.alpha, isFinite)) child.refuse("a mask's number is not finite");
    mask.cutoff = cutoff[0];
    mask.nearest = child.number(1, "as a filter") == 1;
    mask.u = static_cast<AlphaMask::Wrap>(child.number(lastWrap, "as a wrapping"));
    mask.v = static_cast<AlphaMask::Wrap>(child.number(lastWrap, "as a wrapping"));
    return mask;
}

} // namespace

Mesh receivedMesh(ReaderChild& child) {
    child.awaitAnswer();
    Room room;
    return received(child, room);
}

std::map<std::string, Mesh> receivedParts(ReaderChild& child) {
    child.awaitAnswer();
    Room room, ofCards;
    std::vector<std::shared_ptr<const AlphaMask>> masks;
    for (std::uint64_t left = child.number(mostParts, "masks"); left > 0; --left)
        masks.push_back(std::make_shared<const AlphaMask>(receivedMask(child, ofCards)));
    std::map<std::string, Mesh> parts;
    for (std::uint64_t left = child.number(mostParts, "meshes"); left > 0; --left) {
        std::string name = child.text(longestName);
        Mesh mesh = received(child, room);
        if (const std::uint64_t mask = child.number(masks.size(), "as a mask"); mask != withoutMask) {
            MaskedMesh cards{received(child, ofCards), {}, masks[mask - 1]};
            cards.uv.resize(cards.mesh.positions.size());
            child.fill(std::span(cards.uv));
            for (const glm::vec2& uv : cards.uv)
                if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) child.refuse("a place in a texture is not finite");
            mesh.cards = std::make_shared<const MaskedMesh>(std::move(cards));
        }
        parts.insert_or_assign(std::move(name), std::move(mesh));
    }
    return parts;
}

Mesh importMesh(const fs::path& file) {
    const std::string doing = fmt::format("cannot import mesh {}", file.string());
    ReaderChild child(meshReader, doing, filesOf(file, doing), extensionOf(file));
    return receivedMesh(child);
}

std::map<std::string, Mesh> importParts(const fs::path& file, int maskTexels) {
    const std::string doing = fmt::format("cannot read {}", file.string());
    ReaderChild child(meshReader, doing, filesOf(file, doing),
                      fmt::format("{}{}{}", partsOf, maskTexels, extensionOf(file)));
    return receivedParts(child);
}

} // namespace shadowbench
