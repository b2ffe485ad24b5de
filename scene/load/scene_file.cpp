// Scene files: the sections that every scene has. Lights, meshes, objects and expectations are read in read_light.cpp,
// read_environment.cpp, read_meshes.cpp, read_objects.cpp and read_expectations.cpp.
#include "scene/load/scene_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/words.h"
#include "scene/exchange/gltf.h"
#include "scene/load/load.h"
#include "scene/load/memory_need.h"
#include "scene/scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

constexpr int kMostPixels = 8192; // along one side of the image
constexpr int kMostFrames = 100'000;
constexpr int kMostSamples = 1 << 20;

/// `rest` moved by each key of `shift`.
Track shifted(const Track& shift, const glm::dvec3& rest) {
    Track track = shift;
    for (Track::Key& key : track.keys) key.value += rest;
    return track;
}

/// Of keys from frame `first`.
void readCameraPath(const TomlValue& path, const Camera& camera, int first, Track& eye, Track& target) {
    for (const TomlValue& key : path.list()) {
        key.only({"frame", "eye", "target", "shift"});
        if (key.find("shift").has_value() != path.list().front().find("shift").has_value())
            key.fail("give shift (of eye and target) in every key or in none");
        if (key.find("shift") && (key.find("eye") || key.find("target"))) key.fail("give either shift or eye and target");
    }
    const Track shift = readTrack(path, "shift", first);
    eye = shift.keys.empty() ? readTrack(path, "eye", first) : shifted(shift, camera.eye);
    target = shift.keys.empty() ? readTrack(path, "target", first) : shifted(shift, camera.target);
}

void readCamera(const TomlValue& value, Scene& scene) {
    value.only({"eye", "target", "up", "fovy", "near", "far", "path"});
    Camera& camera = scene.camera;
    camera.eye = value.get("eye").vector();
    camera.target = value.get("target").vector();
    if (const auto up = value.find("up")) camera.up = up->vector();
    camera.fovy = value.get("fovy").number();
    if (camera.fovy < 1 || camera.fovy > 170) value.get("fovy").fail("expected degrees from 1 to 170");
    camera.near = value.get("near").positive();
    camera.far = value.get("far").positive();
    if (!(camera.near < camera.far)) value.get("far").fail("expected more than near");
    if (const auto path = value.find("path"))
        readCameraPath(*path, camera, -scene.timeline.approach, scene.eye, scene.target);
}

glm::ivec2 readSize(const TomlValue& value) {
    if (!value.isList()) return glm::ivec2(value.integer(1, kMostPixels));
    const std::vector<TomlValue> sides = value.list();
    if (sides.size() != 2) value.fail(fmt::format("expected a whole number or 2, got {}", sides.size()));
    return {sides[0].integer(1, kMostPixels), sides[1].integer(1, kMostPixels)};
}

glm::ivec2 usualSize(Profile profile) {
    switch (profile) {
    case Profile::Gate:
        return {256, 256};
    case Profile::Standard:
        return {512, 512};
    case Profile::Paper:
        break;
    }
    return {1024, 1024};
}

void readTimeline(const TomlValue& value, Timeline& timeline) {
    value.only({"still", "moving", "approach"});
    if (const auto still = value.find("still")) timeline.still = still->integer(1, kMostFrames);
    if (const auto moving = value.find("moving")) timeline.moving = moving->integer(0, kMostFrames);
    if (const auto approach = value.find("approach")) timeline.approach = approach->integer(0, kMostFrames);
}

/// A light that is all around takes more samples than one in one place.
void readSamples(const TomlValue& root, Scene& scene) {
    if (scene.light.isEnvironment()) {
        scene.referenceSamples = 4096;
        scene.movingReferenceSamples = 1024;
    }
    if (const auto samples = root.find("reference_samples")) scene.referenceSamples = samples->integer(1, kMostSamples);
    if (const auto samples = root.find("moving_reference_samples"))
        scene.movingReferenceSamples = samples->integer(1, kMostSamples);
}

void readObjects(const TomlValue& root, Scene& scene, const fs::path& file) {
    const auto objects = root.find("object");
    if (!objects) root.fail("the scene has no objects; add an [[object]]");
    MeshStore meshes(file.parent_path());
    int number = 0;
    for (const TomlValue& value : objects->list()) {
        ++number;
        if (belongsTo(value, scene.profile)) scene.objects.push_back(readObject(value, number, scene.camera.eye, meshes));
    }
    if (scene.objects.empty()) objects->fail(fmt::format("no object belongs to profile {}", name(scene.profile)));
}

/// Before any other work: what the system would end later, it would end without a word.
void requireMemory(const TomlValue& root, const Scene& scene) {
    const std::uint64_t need = leastMemory(scene), there = memoryThere();
    if (need > there)
        root.get("object").fail(fmt::format("the scene needs {} of memory at least, and there is {}: take fewer instances, "
                                            "coarser meshes or a smaller image",
                                            inBytes(need), inBytes(there)));
}

/// Two transitions of one object must not overlap: an instance is between two levels at most.
void requireSeparateTransitions(const Scene& scene, const TomlValue& band) {
    for (const Object& object : scene.objects)
        for (std::size_t i = 1; i + 1 < object.levels.size(); ++i) {
            const double half = 0.5 * scene.lod->band;
            if (object.levels[i - 1].until * (1 + half) > object.levels[i].until * (1 - half))
                band.fail(fmt::format("{} would be in two transitions at once; make the band narrower", object.name));
        }
}

LodWalk readLodWalk(const TomlValue& value, const Camera& camera) {
    value.only({"frames", "band", "path"});
    LodWalk walk;
    walk.frames = value.get("frames").integer(2, kMostFrames);
    walk.band = value.get("band").positive();
    if (walk.band > 1) value.get("band").fail("expected a share of the distance, at most 1");
    if (const auto path = value.find("path")) readCameraPath(*path, camera, 0, walk.eye, walk.target);
    return walk;
}

/// The walk shows meshes as levels, not as poses.
void requireRigid(const Scene& scene, const TomlValue& lod) {
    for (const Object& object : scene.objects)
        if (!object.poses.empty()) lod.fail(fmt::format("{} deforms; a walk is past rigid meshes", object.name));
}

/// The text of the first line that is a comment.
std::string firstComment(std::string_view toml) {
    while (!toml.empty()) {
        std::string_view line = toml.substr(0, toml.find('\n'));
        toml.remove_prefix(std::min(toml.size(), line.size() + 1));
        if (line.empty() || line.front() != '#') continue;
        line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
        return std::string(line);
    }
    return "";
}

/// Points a problem of the whole scene at the deepest key of the file that it is about.
void requireNoProblem(const TomlValue& root, const Scene& scene) {
    const std::optional<Problem> problem = findProblem(scene);
    if (!problem) return;
    const std::size_t dot = problem->key.find('.');
    const TomlValue section = root.get(problem->key.substr(0, dot));
    if (dot == std::string::npos) section.fail(problem->sentence);
    const auto inner = section.find(problem->key.substr(dot + 1));
    (inner ? *inner : section).fail(problem->sentence);
}

/// An exported scene is named by its folder (docs/exchange.md); other names stay as they are.
fs::path sceneFileOf(const fs::path& given) {
    std::error_code failed;
    for (const char* other : {".obj", ".ply", ".json"})
        if (given.extension() == other)
            throw BadInput(
                fmt::format("cannot load {} as a scene; name a .toml file, whose meshes may come from it, a .gltf "
                            "or .glb file, or the folder of an exported scene",
                            given.string()));
    if (!fs::is_directory(given, failed)) return given;
    if (!fs::exists(given / "scene.json", failed))
        throw BadInput(
            fmt::format("cannot load {}: it is a folder without an exported scene; name a .toml file", given.string()));
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(given, failed), end; !failed && entry != end; entry.increment(failed))
        if (entry->path().extension() == ".toml") files.push_back(entry->path());
    if (files.size() == 1) return files.front();
    throw BadInput(fmt::format("{} has {} .toml files, where an exported scene has one; name a file", given.string(),
                               files.empty() ? "no" : "several"));
}

/// `table`: of the file. `shows`: what the scene is there to show.
Scene sceneOf(toml::table& table, const std::string& shows, const fs::path& file, Profile profile,
              const std::vector<std::string>& metrics) {
    const TomlSource source{file.string(), profileNames(), std::string(name(profile)), kLargestNumber};
    const TomlValue root(source, "", table);
    if (table.empty()) root.fail("the file is empty; a scene has a title, a camera, a light and objects");
    root.only({"title", "profile", "size", "reference_samples", "moving_reference_samples", "camera", "light", "timeline",
               "object", "lod", "tolerance", "expect", "gltf", "unit", "up", "mask_texels"});
    completeFromGltf(table, source, file.parent_path());

    Scene scene;
    scene.id = file.stem().string();
    scene.shows = shows;
    scene.profile = profile;
    scene.title = root.get("title").text();
    if (!belongsTo(root, profile))
        root.get("profile").fail(fmt::format("the scene does not belong to profile {}", name(profile)));
    const auto size = root.find("size");
    scene.size = size ? readSize(*size) : usualSize(profile);
    if (const auto timeline = root.find("timeline")) readTimeline(*timeline, scene.timeline);
    readCamera(root.get("camera"), scene);
    readLight(root.get("light"), file.parent_path(), scene);
    readSamples(root, scene);
    if (const auto tolerance = root.find("tolerance")) scene.tolerance = readTolerances(*tolerance, metrics);
    if (const auto expect = root.find("expect")) readExpectations(*expect, metrics, scene);
    readObjects(root, scene, file);
    if (const auto lod = root.find("lod")) {
        scene.lod = readLodWalk(*lod, scene.camera);
        requireRigid(scene, *lod);
        requireSeparateTransitions(scene, lod->get("band"));
    }
    requireMemory(root, scene);
    requireNoProblem(root, scene);
    moveToOrigin(scene);
    return scene;
}

/// A glTF file, by the scene file that was exported with it or by itself.
Scene sceneFromGltf(const fs::path& file, Profile profile, const std::vector<std::string>& metrics) {
    const exchange::SceneOfGltf found = exchange::sceneOfGltf(file, {.file = file.filename().string()});
    if (found.beside) return parseScene(readFile(*found.beside), *found.beside, profile, metrics);
    const toml::table made = parseToml(found.toml, file.string());
    toml::table table = made; // a copy forgets its lines, which are none of the file's
    Scene scene = sceneOf(table, "", file, profile, metrics);
    scene.id = found.id;
    return scene;
}

} // namespace

Scene parseScene(std::string_view toml, const fs::path& file, Profile profile, const std::vector<std::string>& metrics) {
    toml::table table = parseToml(toml, file.string());
    return sceneOf(table, firstComment(toml), file, profile, metrics);
}

Scene loadScene(const std::string& idOrFile, Profile profile, const std::vector<std::string>& metrics) {
    const std::vector<std::string> ids = builtinScenes();
    if (std::find(ids.begin(), ids.end(), idOrFile) != ids.end())
        return parseScene(builtinSceneText(idOrFile), "scene/library/" + idOrFile + ".toml", profile, metrics);
    const fs::path file = sceneFileOf(idOrFile);
    std::error_code ignored;
    if (file.extension() == ".gltf" || file.extension() == ".glb") return sceneFromGltf(file, profile, metrics);
    if (file.extension() == ".toml" || file.has_parent_path() || fs::exists(file, ignored))
        return parseScene(readFile(file), file, profile, metrics);
    throw BadInput(fmt::format("unknown scene \"{}\"{}; known are {}, or the path of a .toml file", idOrFile,
                               didYouMean(idOrFile, ids), fmt::join(ids, ", ")));
}

} // namespace shadowbench
