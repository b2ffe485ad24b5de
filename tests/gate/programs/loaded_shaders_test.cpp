// What each technique compiles, held against what cmake/reach.cmake finds in the texts of its files.
#include "gate/reach.h"
#include "harness/cells/cell.h"
#include "harness/render/lod_stage.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "studies/sweep/variants.h"
#include "techniques/catalog.h"
#include "tests/support/test_context.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace shadowbench::gate {
namespace {

/// With few samples of the light and of surfaces: their numbers decide no shader.
techniques::Variant withFewSamples(techniques::Variant variant) {
    for (const auto& [name, divisor] : std::map<std::string, int>{{"n", 8}, {"points", 16}})
        if (std::ranges::count(variant.entry->parameters, name, &techniques::Parameter::name) > 0)
            variant = withParameter(variant, name, std::to_string(variant.parameters.integer(name) / divisor));
    return variant;
}

/// A frame at which the light stands still, and one at which it moves.
void drawTwoFrames(const Scene& scene, const techniques::Variant& variant) {
    if (variant.isLod()) {
        lod::LodStage stage(scene, scene.size);
        const auto technique = variant.entry->makeLod(variant.parameters);
        for (const int frame : {0, 1}) {
            stage.show(frame);
            stage.render(*technique);
        }
        return;
    }
    Stage stage(scene);
    const auto technique = variant.entry->make(variant.parameters);
    for (const int frame : {0, 1}) {
        stage.show(frame);
        stage.render(*technique, frame, 1);
    }
}

TEST(LoadedShaders, AreInTheReachOfTheirTechnique) {
    testContext();
    std::vector<Scene> scenes;
    for (const char* id : {"windmills", "soft-contact", "linear-light", "sun-in-sky"}) {
        scenes.push_back(loadScene(id, Profile::Gate));
        scenes.back().size = {32, 32};
        scenes.back().timeline = {1, 1};
    }
    scenes.back().objects.resize(1); // the floor: each small triangle of the others has a point, however few are asked for
    const Reach reach = Reach::own();
    for (const techniques::Variant& variant : techniques::matchVariants("*")) {
        const auto scene =
            std::ranges::find_if(scenes, [&](const Scene& one) { return variant.isLod() || !notApplicable(one, variant); });
        ASSERT_NE(scene, scenes.end()) << variant.name;
        const std::set<std::string> units = reach.units(variant.entry->id, scene->id);
        std::set<std::string>& files = gl::Context::current().shaderFiles();
        files.clear();
        drawTwoFrames(*scene, withFewSamples(variant));
        for (const std::string& file : files) {
            const std::string folder = file.substr(0, file.find('/', file.find('/') + 1));
            EXPECT_TRUE(units.contains(file) || units.contains(folder)) << variant.name << " compiles " << file;
        }
    }
}

} // namespace
} // namespace shadowbench::gate
