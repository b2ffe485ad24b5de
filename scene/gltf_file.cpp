#include "scene/gltf_file.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

namespace shadowbench {
namespace {

constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942; // kinds of chunks
constexpr std::size_t kHeader = 12, kChunkHeader = 8;             // bytes

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0; // little-endian, as a .glb is
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

/// Takes the chunk of that kind that `rest` begins with; nothing where it begins with another.
std::string_view takeChunk(std::string_view& rest, std::uint32_t kind) {
    if (rest.size() < kChunkHeader || wordAt(rest, 4) != kind) return {};
    const std::uint32_t length = wordAt(rest, 0);
    if (length > rest.size() - kChunkHeader)
        throw BadInput("one of its chunks reaches beyond its end; export or copy it again");
    const std::string_view chunk = rest.substr(kChunkHeader, length);
    rest.remove_prefix(kChunkHeader + length);
    return chunk;
}

} // namespace

GlbChunks glbChunks(std::string_view bytes) {
    if (bytes.size() < kHeader || !bytes.starts_with("glTF"))
        throw BadInput("it does not begin as a .glb does; export it as binary glTF 2.0");
    if (const std::uint32_t version = wordAt(bytes, 4); version != 2)
        throw BadInput(fmt::format("it is binary glTF of version {}; export it as glTF 2.0", version));
    const std::uint32_t length = wordAt(bytes, 8);
    if (length < kHeader || length > bytes.size())
        throw BadInput(
            fmt::format("it says that it has {} bytes, and has {}; export or copy it again", length, bytes.size()));
    std::string_view rest = bytes.substr(kHeader, length - kHeader);
    const std::string_view json = takeChunk(rest, kJson);
    if (json.empty()) throw BadInput("its first chunk is no JSON; export it as binary glTF 2.0");
    return {json, takeChunk(rest, kBinary)};
}

void requireHarmless(const std::string& extension) {
    constexpr std::array<std::string_view, 6> harmless{"KHR_lights_punctual", "KHR_materials_", "KHR_texture_",
                                                       "EXT_texture_",        "KHR_technique",  "KHR_xmp"};
    if (std::ranges::any_of(harmless, [&](std::string_view known) { return extension.starts_with(known); })) return;
    throw BadInput(fmt::format("it requires the extension {}, which is not read; export it without (compression and "
                               "quantisation, too)",
                               extension));
}

std::string UniqueNames::add(const std::string& name) {
    int& number = last_[name];
    std::string word = name;
    do {
        if (++number > 1) word = fmt::format("{}_{}", name, number);
    } while (!taken_.insert(word).second);
    return word;
}

std::string PartNames::next(const std::string& mesh, std::size_t number) {
    return names_.add(mesh.empty() ? fmt::format("mesh {}", number) : mesh);
}

} // namespace shadowbench
