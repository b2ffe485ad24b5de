// Scenes on the GPU with their truths, and the cells that tests score on them: each made once in a test process.
#pragma once

#include "harness/cells/cell.h"
#include "harness/cells/truths.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "tests/support/test_context.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace shadowbench {

/// References are shared by all tests of one build: several programs may fill the folder at once.
inline groundtruth::Cache testCache() {
    return groundtruth::Cache(std::filesystem::temp_directory_path() / "shadowbench-test-references");
}

/// A scene whose cells are scored once each, without measuring time.
class CellScene {
public:
    explicit CellScene(Scene scene) : scene_(std::move(scene)) {}
    CellScene(const CellScene&) = delete;
    CellScene& operator=(const CellScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    SceneFrames& frames() { return frames_; }
    Stage& stage() { return frames_.stage(); }
    Truths& truths() { return truths_; }

    const Record& scored(const std::string& variant) { return kept(variant, CellWork::LeftOut); }

    /// With its work.
    const Record& counted(const std::string& variant) { return kept(variant, CellWork::Counted); }

private:
    const Record& kept(const std::string& variant, CellWork work) {
        const std::pair key(variant, work);
        if (const auto found = records_.find(key); found != records_.end()) return found->second;
        Record record;
        CellImages images;
        scoreCell(frames_, techniques::parseVariant(variant), 1, record, images, work);
        return records_.emplace(key, std::move(record)).first->second;
    }

    Scene scene_;
    groundtruth::Cache cache_ = testCache();
    Truths truths_{scene_, cache_};
    SceneFrames frames_{scene_, truths_};
    std::map<std::pair<std::string, CellWork>, Record> records_;
};

/// A built-in scene at its gate size with still frames only, so that one reference of each kind is enough.
inline CellScene& stillScene(const std::string& id, int still = 60) {
    testContext(); // outlives the scenes
    static std::map<std::pair<std::string, int>, CellScene> scenes;
    const auto key = std::pair(id, still);
    if (const auto found = scenes.find(key); found != scenes.end()) return found->second;
    Scene scene = loadScene(id, Profile::Gate);
    scene.timeline = {still, 0};
    return scenes.try_emplace(key, std::move(scene)).first->second;
}

} // namespace shadowbench
