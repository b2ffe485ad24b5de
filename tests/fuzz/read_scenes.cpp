#include "base/base64.h"
#include "base/toml_value.h"
#include "harness/metrics/table.h"
#include "scene/exchange/export.h"
#include "scene/exchange/gltf.h"
#include "scene/gltf_file.h"
#include "scene/load/load.h"
#include "scene/mesh_faults.h"
#include "scene/meshes/foreign_mesh.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <functional>

namespace shadowbench::fuzz {
namespace {

/// Counts of triangles, instances and frames, among other whole numbers.
void addCounts(const toml::node& node, std::vector<double>& counts) {
    constexpr std::int64_t most = 4'000'000; // of any that the reader takes
    if (const auto* integer = node.as_integer(); integer != nullptr && integer->get() > 0 && integer->get() <= most)
        counts.push_back(static_cast<double>(integer->get()));
    if (const toml::array* list = node.as_array())
        for (const toml::node& item : *list) addCounts(item, counts);
    if (const toml::table* table = node.as_table())
        for (const auto& [key, item] : *table) addCounts(item, counts);
}

/// Whether a scene within the documented limits would take seconds to load: its counts multiply.
bool isLarge(std::string_view text) {
    constexpr double most = 3e5;
    std::vector<double> counts{1, 1, 1};
    isTaken([&] { addCounts(parseToml(text, "scene.toml"), counts); });
    std::ranges::sort(counts, std::greater());
    return counts[0] * counts[1] * counts[2] > most;
}

/// As the process does that loads a glTF file; what it makes of it must be a scene file's text.
void readGltfScene(const std::string& name, std::string_view input) {
    const exchange::SceneOfGltf scene = exchange::sceneOfGltf(kept(name, input), {.file = name});
    require(isTaken([&] { parseToml(scene.toml, name); }), "what was made of a glTF file is no TOML: " + scene.toml);
}

/// 2 × 2 texels, half of them clear.
const std::string leaf =
    *fromBase64("iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAEklEQVR42mP4z8DwH4SBkAGMAUHQBfsM2jl8AAAAAElFTkSuQmCC");

/// As the child does that reads its meshes.
void readParts(const std::string& extension, std::string_view input) {
    for (const auto& part :
         readPartsHere({extension, std::string(input), {{"scene.bin", std::string(1000, '\1')}, {"leaf.png", leaf}}})) {
        requireNumbers(part.second, part.first);
        isTaken([&] { requireWellFormed(part.second, part.first); });
    }
}

} // namespace

void readScene(std::string_view input) {
    if (isLarge(input)) return;
    static const std::filesystem::path mesh = kept("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    parseScene(input, folder() / "scene.toml", Profile::Gate, metrics::boundedMetrics());
}

void readMeshParts(std::string_view input) {
    filesNeededBy(input); // as the process does that starts the child
    readParts(".gltf", input);
}

void readGltfText(std::string_view input) { readGltfScene("scene.gltf", input); }

void readGltfBinary(std::string_view input) {
    filesNeededBy(glbChunks(input).json);
    isTaken([&] { readGltfScene("scene.glb", input); });
    readParts(".glb", input);
}

void readSceneJson(std::string_view input) {
    for (const std::string& file : exchange::exportedFiles(input))
        require(std::filesystem::path(file).filename() == file && file != ".." && file != ".",
                "an export's file lies outside of its folder: " + file);
}

} // namespace shadowbench::fuzz
