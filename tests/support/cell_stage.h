// A standard scene on the GPU with its truths, for tests of whole cells.
#pragma once

#include "harness/cells/cell.h"
#include "harness/cells/truths.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <filesystem>
#include <string>

namespace shadowbench {

inline gl::Context& testContext() {
    static const auto context = gl::Context::create({.debug = true});
    return *context;
}

/// References are shared by all tests of one build: several programs may fill the folder at once.
inline groundtruth::Cache testCache() {
    return groundtruth::Cache(std::filesystem::temp_directory_path() / "shadowbench-test-references");
}

/// The scene at its gate size with still frames only, so that one reference of each kind is enough.
inline Scene stillScene(const std::string& id, int still = 60) {
    testContext();
    Scene scene = loadScene(id, Profile::Gate);
    scene.timeline = {still, 0};
    return scene;
}

/// Scores one variant without measuring time.
inline Record scored(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    const groundtruth::Cache cache = testCache();
    Truths truths(scene, cache);
    const MeasureOptions options{.seed = 1, .time = false, .images = {}};
    Record record;
    CellImages images;
    runCell(scene, stage, truths, techniques::parseVariant(variant), options, record, images);
    return record;
}

} // namespace shadowbench
