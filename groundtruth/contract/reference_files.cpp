#include "groundtruth/contract/reference_files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/image_io.h"
#include "base/json_text.h"

#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace shadowbench::groundtruth {
namespace {

static_assert(std::endian::native == std::endian::little, "entries hold little-endian arrays");

using Json = nlohmann::json;

constexpr std::string_view formatName = "shadowbench reference";
constexpr int formatVersion = 1;
constexpr int largestSide = 65536;

using Checksum = std::uint64_t;

[[noreturn]] void damaged(std::string_view what) { throw BadInput(fmt::format("a stored reference is damaged: {}", what)); }

Json toJson(const Provenance& p) {
    return {{"oracle", p.oracle},   {"key", p.key},           {"samples", p.samples}, {"tools", p.tools},
            {"seconds", p.seconds}, {"measured", p.measured}, {"sources", p.sources}};
}

Provenance provenanceFrom(const Json& json) {
    Provenance p;
    json.at("oracle").get_to(p.oracle);
    json.at("key").get_to(p.key);
    p.samples = wholeNumber<int>(json.at("samples"));
    json.at("tools").get_to(p.tools);
    json.at("seconds").get_to(p.seconds);
    json.at("measured").get_to(p.measured);
    p.sources = json.value("sources", ""); // entries of older programs have none
    return p;
}

/// Calls `visit` with every image of a reference, in the order they are stored in.
template <typename AnyReference, typename Visit>
void forImages(AnyReference& reference, const Visit& visit) {
    visit(reference.visibility);
    visit(reference.sigma);
    visit(reference.edgeDistance);
    visit(reference.surface);
    visit(reference.id);
    visit(reference.position);
}

template <typename T>
std::size_t byteCount(const Image<T>& image) {
    static_assert(std::is_trivially_copyable_v<T>);
    return image.size() * sizeof(T);
}

/// The header line of `bytes`, checked; `bytes` is cut to what follows it.
EntryHeader takeHeader(std::string_view& bytes) {
    const std::size_t end = bytes.find('\n');
    if (end == bytes.npos) damaged("it has no header");
    const Json json = Json::parse(boundedJson(bytes.substr(0, end), "a stored reference is damaged"), nullptr, false);
    bytes.remove_prefix(end + 1);
    if (!json.is_object() || json.value("format", Json()) != formatName) damaged("its header is not ours");
    if (json.value("version", Json()) != formatVersion) damaged("it has another format version");
    try {
        EntryHeader header;
        json.at("key").get_to(header.key);
        header.width = wholeNumber<int>(json.at("width"));
        header.height = wholeNumber<int>(json.at("height"));
        header.provenance = provenanceFrom(json.at("provenance"));
        return header;
    } catch (const Json::exception&) {
        damaged("its header lacks a field");
    }
}

bool inRange(int side) { return side >= 1 && side <= largestSide; }

void checkSurfaces(const Image<Surface>& surface) {
    for (const Surface s : surface)
        if (s > Surface::OnEdge) damaged("it has an unknown kind of surface");
}

} // namespace

std::string encode(const Reference& reference) {
    const Json header{{"format", formatName},
                      {"version", formatVersion},
                      {"key", reference.provenance.key},
                      {"width", reference.visibility.width()},
                      {"height", reference.visibility.height()},
                      {"provenance", toJson(reference.provenance)}};
    std::string bytes = header.dump() + "\n";
    forImages(reference, [&](const auto& image) {
        if (!image.sameSize(reference.visibility)) throw InternalError("a reference's images differ in size");
        bytes.append(reinterpret_cast<const char*>(image.data()), byteCount(image));
    });
    const Checksum sum = hash64(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

Reference decode(std::string_view bytes, std::string_view key) {
    Checksum stored = 0;
    if (bytes.size() < sizeof stored) damaged("it is too short");
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    bytes.remove_suffix(sizeof stored);
    if (hash64(bytes) != stored) damaged("its checksum is wrong");

    const EntryHeader header = takeHeader(bytes);
    if (header.key != key || header.provenance.key != key) damaged("it belongs to another key");
    if (!inRange(header.width) || !inRange(header.height)) damaged("its size is out of range");
    Reference reference;
    reference.provenance = header.provenance;
    forImages(reference, [&](auto& image) {
        using AnyImage = std::remove_cvref_t<decltype(image)>;
        const std::size_t pixels = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
        if (bytes.size() < pixels * sizeof(*image.data())) damaged("its images are too short");
        image = AnyImage(header.width, header.height);
        std::memcpy(image.data(), bytes.data(), byteCount(image));
        bytes.remove_prefix(byteCount(image));
    });
    if (!bytes.empty()) damaged("its images are too long");
    checkSurfaces(reference.surface);
    return reference;
}

EntryHeader decodeHeader(std::string_view bytes) { return takeHeader(bytes); }

std::string provenanceJson(const Provenance& provenance) { return toJson(provenance).dump(2) + "\n"; }

void writeReference(const Reference& reference, const std::filesystem::path& folder) {
    Image<float> mask(reference.surface.width(), reference.surface.height());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = reference.surface[i] == Surface::Receiver ? 1 : 0;
    writeExr(folder / "visibility.exr", {{"V", &reference.visibility},
                                         {"sigma", &reference.sigma},
                                         {"mask", &mask},
                                         {"edge_distance", &reference.edgeDistance}});
    writeFile(folder / "provenance.json", provenanceJson(reference.provenance));
}

} // namespace shadowbench::groundtruth
