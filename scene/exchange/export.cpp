#include "scene/exchange/export.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/json_text.h"
#include "scene/exchange/gltf.h"
#include "scene/exchange/texts.h"
#include "scene/sky.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

namespace shadowbench::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDescription = "scene.json";            // written last: a folder that has it is complete
constexpr const char* kUnfinished = ".scene.json.unfinished"; // lists what an export is about to remove and write

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// The files of the exports that `folder` holds, by the lists in their scene.json and of one that was killed; nothing if it
/// holds none.
std::vector<std::string> earlierExports(const fs::path& folder) {
    std::vector<std::string> files;
    for (const char* list : {kDescription, kUnfinished})
        if (isThere(folder / list))
            for (std::string& file : exportedFiles(readFile(folder / list))) files.push_back(std::move(file));
    return files;
}

/// Whether the folder has something in it but what a killed writer left.
bool holdsFiles(const fs::path& folder) {
    std::error_code failed;
    const fs::directory_iterator entries(folder, failed);
    return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
        return !isTemporary(entry.path()) && entry.path().filename() != kUnfinished;
    });
}

/// What may be removed from the folder: it is new, empty, or an earlier export's. Nothing of the user's is overwritten.
std::vector<std::string> replaceable(const fs::path& folder) {
    if (folder.empty()) throw BadInput("cannot export into a folder without a name; name one");
    if (!isThere(folder)) return {};
    std::error_code failed;
    if (!fs::is_directory(folder, failed))
        throw BadInput(fmt::format("cannot export into {}: it is a file; name a folder", folder.string()));
    std::vector<std::string> earlier = earlierExports(folder);
    if (earlier.empty() && holdsFiles(folder))
        throw BadInput(
            fmt::format("cannot export into {}: it holds other files; name a new or an empty folder", folder.string()));
    return earlier;
}

/// Files that are all written, or none: what is there when something fails is removed again.
class Files {
public:
    explicit Files(fs::path folder) : folder_(std::move(folder)), madeFolder_(!isThere(folder_)) {}
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;
    ~Files() {
        if (complete_) return;
        std::error_code ignored;
        for (const std::string& name : names_) fs::remove(folder_ / name, ignored);
        fs::remove(folder_ / kUnfinished, ignored);
        if (madeFolder_) fs::remove(folder_, ignored); // unless something else is in it
    }

    /// Removes `earlier`, which `names` will follow. The list of both outlives a kill, so that the next export goes on.
    void replace(const std::vector<std::string>& earlier, const std::vector<std::string>& names) const {
        std::vector<std::string> all = earlier;
        all.insert(all.end(), names.begin(), names.end());
        writeFile(folder_ / kUnfinished, nlohmann::json{{"format", "shadowbench-scene"}, {"files", all}}.dump());
        std::error_code failed;
        for (const std::string& file : earlier)
            if (fs::is_regular_file(folder_ / file, failed)) fs::remove(folder_ / file, failed);
    }

    void add(const std::string& name, std::string_view content) {
        addWith(name, [&](const fs::path& file) { writeFile(file, content); });
    }
    void addWith(const std::string& name, const std::function<void(const fs::path&)>& write) {
        write(folder_ / name);
        names_.push_back(name);
    }
    std::vector<std::string> complete() {
        complete_ = true;
        std::error_code ignored;
        fs::remove(folder_ / kUnfinished, ignored);
        return names_;
    }

private:
    fs::path folder_;
    bool madeFolder_;
    bool complete_ = false;
    std::vector<std::string> names_;
};

const Image<float>* skyImageOf(const Scene& scene) {
    if (!scene.light.isEnvironment()) return nullptr;
    const auto* sky = std::get_if<ImageSky>(&scene.light.environment->sky);
    return sky == nullptr ? nullptr : &sky->radiance;
}

} // namespace

std::vector<std::string> exportedFiles(std::string_view description) {
    const auto json = nlohmann::json::parse(boundedJson(description, kDescription), nullptr, false);
    std::vector<std::string> files;
    if (!json.is_object() || json.value("format", nlohmann::json()) != "shadowbench-scene") return files;
    for (const auto& file : json.value("files", nlohmann::json::array())) {
        if (!file.is_string()) continue;
        const auto name = file.get<std::string>();
        if (!name.empty() && fs::path(name).filename() == name && name != "." && name != "..") files.push_back(name);
    }
    return files;
}

Exported exportScene(const Scene& scene, const fs::path& folder) {
    const Parts parts(scene);
    const std::vector<int> frames = scoredFrames(scene);
    const Snapshot scored = snapshot(scene, frames.front());
    GltfFiles gltf = gltfOf(scene, scored, parts, "scene", Holes::Cut);
    const std::string sceneFile = scene.id + ".toml";
    const Image<float>* sky = skyImageOf(scene);
    FileNames names{sceneFile, {}, {"scene.mtl", "scene.obj", sceneFile}};
    if (std::ranges::any_of(parts.list(), [](const Part& part) { return part.mesh->cards != nullptr; })) {
        names.cards = "cards.gltf";
        std::ranges::move(gltfOf(scene, scored, parts, "cards", Holes::Masked), std::back_inserter(gltf));
    }
    for (const auto& [name, content] : gltf) names.all.push_back(name);
    if (sky != nullptr) names.all.emplace_back("sky.exr");
    names.all.emplace_back(kDescription);

    const std::vector<std::string> earlier = replaceable(folder);
    Files files(folder);
    files.replace(earlier, names.all);
    for (const auto& [name, content] : gltf) files.add(name, content);
    files.add("scene.mtl", mtlOf(parts));
    files.add("scene.obj", objOf(parts));
    files.add(sceneFile, tomlOf(scene, parts));
    if (sky != nullptr) files.addWith("sky.exr", [&](const fs::path& file) { writeExr(file, {{"Y", sky}}); });
    files.add(kDescription, sceneJsonOf(scene, parts, frames, names));
    return {files.complete(), frames};
}

} // namespace shadowbench::exchange
