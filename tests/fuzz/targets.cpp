#include "tests/fuzz/target.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "base/words.h"
#include "tests/fuzz/readers.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace shadowbench::fuzz {
namespace {

constexpr auto all = std::to_array<Target>({
    {"scene", Kind::Text, 8192, "toml", "scene/library/*.toml", readScene},
    {"mesh_parts", Kind::Text, 8192, "json", "", readMeshParts},
    {"gltf_scene", Kind::Text, 8192, "json", "", readGltfText},
    {"glb_scene", Kind::Bytes, 4096, "json", "", readGltfBinary},
    {"mesh_obj", Kind::Text, 2048, "obj", "", readObj},
    {"mesh_ply", Kind::Text, 2048, "ply", "", readPly},
    {"mesh_gltf", Kind::Text, 4096, "json", "", readGltf},
    {"mesh_glb", Kind::Bytes, 4096, "json", "", readGlb},
    {"image_exr", Kind::Bytes, 2048, "image", "", readImage},
    {"image_png", Kind::Bytes, 2048, "image", "", readImage},
    {"image_pfm", Kind::Bytes, 512, "image", "", readImage},
    {"mesh_answer", Kind::Bytes, 512, "words", "", readMeshAnswer},
    {"parts_answer", Kind::Bytes, 512, "words", "", readPartsAnswer},
    {"image_answer", Kind::Bytes, 512, "words", "", readImageAnswer},
    {"scene_json", Kind::Text, 4096, "json", "", readSceneJson},
    {"records", Kind::Text, 16384, "json", "", readResults},
    {"compared_records", Kind::Text, 16384, "json", "", readComparedRecords},
    {"manifest", Kind::Text, 4096, "json", "", readManifestLines},
    {"cell", Kind::Text, 16384, "json", "", readMeasuredCell},
    {"merge", Kind::Text, 16384, "json", "", readMergedFolder},
    {"cache_entry", Kind::Bytes, 4096, "json", "", readCacheEntry},
    {"golden_lock", Kind::Text, 8192, "json", "", readGoldenLock},
    {"renderers", Kind::Text, 4096, "toml", "", readRendererList},
    {"timing", Kind::Text, 1024, "json", "", readTimingFile},
    {"bounds", Kind::Text, 8192, "toml", "", readBounds},
    {"policy", Kind::Text, 8192, "json", "", readPolicyOfAProgram},
    {"claims", Kind::Text, 8192, "json", "", readClaimList},
    {"behaviours", Kind::Text, 4096, "json", "", readBehaviourList},
    {"papers", Kind::Text, 8192, "json", "", readPaperPages},
    {"technique", Kind::Text, 4096, "toml", "", readTechniqueDescription},
    {"technique_shader", Kind::Text, 2048, "words", "", readTechniqueShader},
    {"expectations", Kind::Text, 4096, "toml", "", readExpectationList},
    {"words", Kind::Text, 256, "words", "", readWords},
});

} // namespace

std::span<const Target> targets() { return all; }

const Target& targetNamed(std::string_view name) {
    const auto found = std::ranges::find(all, name, &Target::name);
    if (found != all.end()) return *found;
    std::vector<std::string> names;
    for (const Target& target : all) names.emplace_back(target.name);
    throw BadInput(
        fmt::format("there is no target \"{}\"{}; there are {}", name, didYouMean(name, names), fmt::join(names, ", ")));
}

bool isTaken(const std::function<void()>& read) {
    try {
        read();
        return true;
    } catch (const Error& error) {
        if (error.code() != ExitCode::BadInput && error.code() != ExitCode::Inconclusive) throw;
        require(!std::string_view(error.what()).empty(), "a refusal says nothing");
        return false;
    }
}

void require(bool holds, const std::string& sentence) {
    if (!holds) throw std::logic_error(sentence);
}

const std::filesystem::path& folder() {
    static const TemporaryFolder own;
    return own.path();
}

std::filesystem::path kept(const std::string& name, std::string_view content) {
    const std::filesystem::path file = folder() / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << content; // not writeFile, which waits for the disk
    return file;
}

} // namespace shadowbench::fuzz
