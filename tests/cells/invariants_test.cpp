// What holds for every shadow technique on every scene.
#include "harness/render/motion.h"
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "scene/sky.h"
#include "studies/sweep/variants.h"
#include "tests/support/cell_stage.h"
#include "tests/support/test_names.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace shadowbench {
namespace {

struct Case {
    std::string scene, variant;
};

/// How a failing case is printed.
void PrintTo(const Case& cell, std::ostream* out) { *out << cell.variant << " on " << cell.scene; }

/// A standard scene with two still and two moving frames that are not square, and small enough for all techniques.
Scene smallScene(const std::string& id) {
    Scene scene = loadScene(id, Profile::Gate);
    scene.timeline = {2, 2};
    scene.size = {72, 64};
    return scene;
}

/// The same on the GPU, made once.
CellScene& smallCells(const std::string& id) {
    testContext(); // outlives the scenes
    static std::map<std::string, CellScene> scenes;
    if (const auto found = scenes.find(id); found != scenes.end()) return found->second;
    return scenes.try_emplace(id, smallScene(id)).first->second;
}

/// The first figure of a crowd, which a technique draws as it draws all.
CellScene& oneWalker() {
    testContext();
    static CellScene cells = [] {
        Scene scene = smallScene("skinned-crowd");
        for (Object& object : scene.objects) object.instances.resize(1);
        return CellScene(std::move(scene));
    }();
    return cells;
}

std::vector<std::string> shadowVariants() {
    std::vector<std::string> names;
    for (const techniques::Variant& variant : techniques::matchVariants("*"))
        if (!variant.isLod()) names.push_back(variant.name);
    return names;
}

bool has(const techniques::Variant& variant, const char* parameter) {
    return std::ranges::count(variant.entry->parameters, parameter, &techniques::Parameter::name) > 0;
}

/// With an eighth of the light's samples if it has these: each is drawn as all are, so that their number decides nothing of
/// what holds of every one.
techniques::Variant withFewSamples(const std::string& name) {
    const techniques::Variant variant = techniques::parseVariant(name);
    return has(variant, "n") ? withParameter(variant, "n", std::to_string(variant.parameters.integer("n") / 8)) : variant;
}

/// And with a small map if it has one: the size decides nothing of a cell's invariants.
std::string madeSmall(const std::string& name) {
    const techniques::Variant variant = withFewSamples(name);
    return has(variant, "map") ? withParameter(variant, "map", "128").name : variant.name;
}

/// Those that have an answer for lights other than environments.
std::vector<std::string> variantsForAreaLights() {
    std::vector<std::string> names = shadowVariants();
    std::erase_if(names, [](const std::string& name) {
        return techniques::parseVariant(name).entry->environment == techniques::EnvironmentAnswer::Only;
    });
    for (std::string& name : names) name = withFewSamples(name).name;
    return names;
}

/// Every cell that applies; a test below says which do not.
std::vector<Case> everyCell() {
    std::vector<Case> cases;
    for (const std::string& id : standardScenes()) {
        const Scene scene = smallScene(id);
        for (const std::string& variant : shadowVariants())
            if (!notApplicable(scene, techniques::parseVariant(variant))) cases.push_back({id, madeSmall(variant)});
    }
    return cases;
}

/// What a technique needs that a standard scene lacks; empty if the cell applies.
std::string need(const Scene& scene, const techniques::Entry& entry) {
    if (entry.environment == techniques::EnvironmentAnswer::Only) return "needs an environment light";
    if (entry.answer == techniques::Answer::Soft && !scene.light.isArea()) return "needs an area light";
    if (entry.id == "linear-visibility" && scene.light.kind != LightKind::Line)
        return "interpolates between the ends of a linear light";
    const bool isOmnidirectional = entry.id == "sm-cube" || entry.id == "sm-dual-paraboloid";
    if (isOmnidirectional && scene.light.kind == LightKind::Directional) return "needs a light with a position";
    return "";
}

TEST(Cells, UnderASkyOnlyThoseApplyThatSayTheyAnswerForOne) {
    Scene scene = smallScene("simple");
    scene.light = environmentLight({});
    for (const std::string& name : shadowVariants()) {
        const techniques::Variant variant = techniques::parseVariant(name);
        const std::optional<std::string> reason = notApplicable(scene, variant);
        if (variant.entry->environment == techniques::EnvironmentAnswer::None) {
            ASSERT_TRUE(reason.has_value()) << name;
            EXPECT_NE(reason->find("the light of simple is an environment"), std::string::npos) << name << ": " << *reason;
        } else if (variant.entry->id == "none") {
            EXPECT_FALSE(reason.has_value()) << *reason;
        }
    }
}

TEST(Cells, DoNotApplyWhereTheSceneLacksWhatTheTechniqueNeedsAndNowhereElse) {
    for (const std::string& id : standardScenes()) {
        const Scene scene = smallScene(id);
        for (const std::string& name : shadowVariants()) {
            const techniques::Variant variant = techniques::parseVariant(name);
            const std::string reason = notApplicable(scene, variant).value_or("");
            const std::string needed = need(scene, *variant.entry);
            EXPECT_EQ(reason.substr(0, needed.size()), needed) << name << " on " << id;
            EXPECT_EQ(reason.empty(), needed.empty()) << name << " on " << id << ": " << reason;
        }
    }
}

enum class Figures { NotAsked, Asked };

/// A few frames, some of them moving; images of all of them one after another.
std::vector<Image<float>> shortRun(Stage& stage, const std::string& name, Figures figures = Figures::NotAsked) {
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    std::vector<Image<float>> images;
    for (int frame = 0; frame < 4; ++frame) {
        stage.show(frame);
        stage.render(*technique, frame, 1);
        images.push_back(stage.visibility());
        if (figures == Figures::Asked) {
            EXPECT_NO_THROW(techniques::declaredFigures(*variant.entry, technique->figures(stage.frame(frame, 1)))) << name;
        }
    }
    return images;
}

class EveryCell : public testing::TestWithParam<Case> {};

TEST_P(EveryCell, IsInRangeAndTheSameEveryTime) {
    Stage& stage = smallCells(GetParam().scene).stage();
    const auto images = shortRun(stage, GetParam().variant);
    for (const Image<float>& image : images)
        for (const float v : image) {
            ASSERT_TRUE(std::isfinite(v));
            ASSERT_GE(v, 0.0F);
            ASSERT_LE(v, 1.0F);
        }
    EXPECT_EQ(shortRun(stage, GetParam().variant, Figures::Asked), images); // counting leaves no trace in the next frame
}

Image<float> drawnBy(Stage& stage, techniques::Technique& technique, const Snapshot& shown, int index) {
    stage.show(shown);
    stage.render(technique, index, 1);
    return stage.visibility();
}

TEST_P(EveryCell, IsAfterAMoveWhatItIsFromTheBeginning) {
    const techniques::Variant variant = techniques::parseVariant(GetParam().variant);
    if (variant.entry->temporal) return; // its image is that of the frames before, too
    CellScene& cells = smallCells(GetParam().scene);
    const Snapshot standing = snapshot(cells.scene(), 1), home = returned(standing, Casters::Move);
    Snapshot bothAway = displaced(standing, Casters::Move), castersAway = bothAway;
    castersAway.light = standing.light;
    const auto make = [&] { return variant.entry->make(variant.parameters); };
    const auto technique = make();
    int index = 0;
    drawnBy(cells.stage(), *technique, standing, ++index);
    for (const Snapshot& away : {castersAway, bothAway}) {
        drawnBy(cells.stage(), *technique, away, ++index);
        const Image<float> image = drawnBy(cells.stage(), *technique, home, ++index);
        ASSERT_EQ(image, drawnBy(cells.stage(), *make(), home, index)) << "frame " << index;
    }
}

TEST_P(EveryCell, IsAfterAResetWhatItIsNew) {
    const techniques::Variant variant = techniques::parseVariant(GetParam().variant);
    Stage& stage = smallCells(GetParam().scene).stage();
    stage.show(1);
    const auto technique = variant.entry->make(variant.parameters);
    const auto firstFrame = [&] {
        gl::WorkMeter meter;
        stage.render(*technique, 0, 1);
        const gl::WorkCount work = meter.finish();
        return std::tuple(work.fragments, work.vertices, work.primitives, work.draws, work.passes, stage.visibility());
    };
    const auto made = firstFrame();
    stage.render(*technique, 1, 1);
    technique->reset();
    EXPECT_EQ(firstFrame(), made);
}

std::string caseName(const testing::TestParamInfo<Case>& tested) {
    return testName(tested.param.scene + "_" + tested.param.variant);
}

INSTANTIATE_TEST_SUITE_P(TechniquesTimesScenes, EveryCell, testing::ValuesIn(everyCell()), caseName);

class EveryVariant : public testing::TestWithParam<std::string> {};

/// The least visibility where all is lit. Bounds over moments without a bias are as near to 1 as depths are rounded, whose
/// least variance is of that size: no picture of 8 bits shows it.
float leastOfLit(std::string_view variant) {
    const std::string_view id = variant.substr(0, variant.find(':'));
    return id == "evsm" || id == "msm" || id == "sat-vsm" ? 1 - 0.5F / 255 : 1;
}

TEST_P(EveryVariant, LeavesAFullyLitSceneLit) {
    testContext();
    Scene scene;
    scene.id = "lit";
    scene.size = {64, 64};
    scene.timeline = {2, 2};
    scene.camera = {{0.3, 3.1, 5.2}, {0.1, 0, 0}, {0, 1, 0}, 40, 0.1, 50};
    scene.light = {LightKind::Rectangle, {0.7, 5.3, 0.4}, {0, -1, 0}, {1, 0, 0.1}, {-0.1, 0, 1}};
    Object ground;
    ground.levels.push_back({std::make_shared<const Mesh>(box({8, 0.2, 8}))});
    ground.instances.push_back({});
    scene.objects.push_back(ground);
    if (notApplicable(scene, techniques::parseVariant(GetParam()))) // one for linear lights
        scene.light = {LightKind::Line, {0.7, 5.3, 0.4}, {0, -1, 0}, {1, 0, 0.1}, {0, 0, 0}};
    std::size_t top = 0;
    Stage stage(scene);
    const auto images = shortRun(stage, GetParam());
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    for (const Image<float>& image : images)
        for (std::size_t i = 0; i < image.size(); ++i) {
            if (drawn.id[i] == 0 || drawn.position[i].y < 0.0999F) continue;
            ++top;
            ASSERT_GE(image[i], leastOfLit(GetParam())) << "pixel " << i;
            ASSERT_LE(image[i], 1.0F) << "pixel " << i;
        }
    EXPECT_GT(top, 2000U);
}

TEST_P(EveryVariant, DrawsACasterThatDeformsAsFromTheBeginning) {
    const techniques::Variant variant = techniques::parseVariant(madeSmall(GetParam()));
    CellScene& cells = oneWalker(); // whose transform stands still
    if (variant.entry->temporal || notApplicable(cells.scene(), variant)) return;
    const int moving = cells.scene().timeline.still;
    const auto draw = [&](techniques::Technique& technique, int frame) {
        return drawnBy(cells.stage(), technique, snapshot(cells.scene(), frame), frame);
    };
    const auto kept = variant.entry->make(variant.parameters);
    draw(*kept, moving - 1);
    EXPECT_EQ(draw(*kept, moving), draw(*variant.entry->make(variant.parameters), moving));
}

/// A box over a slab, all lengths `scale` times as long.
Scene boxAtScale(double scale) {
    Scene scene;
    scene.id = "scaled";
    scene.size = {72, 64};
    scene.timeline = {2, 2};
    scene.camera = {
        scale * glm::dvec3(2.3, 3.1, 4.2), scale * glm::dvec3(0.1, 0, 0), {0, 1, 0}, 40, 0.1 * scale, 50 * scale};
    scene.light = {LightKind::Rectangle,
                   scale * glm::dvec3(0.7, 4.3, 0.4),
                   {0, -1, 0},
                   scale * glm::dvec3(0.5, 0, 0.1),
                   scale * glm::dvec3(-0.1, 0, 0.5)};
    for (const auto& [size, at] : {std::pair{glm::dvec3(8, 0.2, 8), glm::dvec3(0)}, {{0.6, 0.5, 0.7}, {0.1, 0.7, 0.2}}}) {
        Object object;
        Mesh mesh = box(size);
        for (glm::vec3& position : mesh.positions) position *= static_cast<float>(scale);
        object.levels.push_back({std::make_shared<const Mesh>(std::move(mesh))});
        object.instances.push_back({glm::translate(glm::dmat4(1), scale * at), 0});
        scene.objects.push_back(object);
    }
    return scene;
}

/// Whether a variant has lengths in metres, as its engine has: how far it marches, how wide it filters at most, how depths
/// weigh.
bool knowsMetres(std::string_view variant) {
    return variant.starts_with("screen-contact") || variant.starts_with("ray-classified") ||
           (variant.starts_with("pcss-vogel") && variant.find("widest=0.56") != std::string_view::npos);
}

/// The share of pixels that a unit may change: layers that lie at fixed depths. A history is mixed in single precision.
double changedByUnit(std::string_view variant) { return variant.starts_with("layered-attenuation") ? 0.002 : 0; }
float roundedByUnit(std::string_view variant) { return variant.starts_with("temporal-soft") ? 1e-5F : 0; }

/// By a power of two, which no sum or product of floats rounds otherwise.
TEST_P(EveryVariant, DrawsAModelOfAnySizeAlike) {
    testContext();
    const auto imagesAt = [&](double scale) {
        Scene scene = boxAtScale(scale);
        if (!techniques::parseVariant(GetParam()).entry->temporal) scene.timeline = {1, 0};
        if (notApplicable(scene, techniques::parseVariant(GetParam()))) { // one for linear lights
            scene.light.kind = LightKind::Line;
            scene.light.v = {0, 0, 0};
        }
        Stage stage(scene);
        return shortRun(stage, knowsMetres(GetParam()) ? GetParam() : madeSmall(GetParam()));
    };
    const auto images = imagesAt(1), larger = imagesAt(64);
    std::size_t different = 0, all = 0;
    for (std::size_t frame = 0; frame < images.size(); ++frame)
        for (std::size_t i = 0; i < images[frame].size(); ++i, ++all)
            different += std::abs(images[frame][i] - larger[frame][i]) > roundedByUnit(GetParam()) ? 1 : 0;
    if (knowsMetres(GetParam()))
        EXPECT_GT(different, 0U) << "it has no length in metres";
    else
        EXPECT_LE(different, changedByUnit(GetParam()) * static_cast<double>(all)) << "of " << all << " pixels";
}

INSTANTIATE_TEST_SUITE_P(Techniques, EveryVariant, testing::ValuesIn(variantsForAreaLights()), nameOfText);

} // namespace
} // namespace shadowbench
