#include "gate/check/row_checks.h"

#include "harness/render/motion.h"
#include "harness/render/stage.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

namespace shadowbench::gate {
namespace {

using techniques::Answer;
using techniques::Entry;
using techniques::Variant;

/// A box over a slab. Odd coordinates, so that no edge runs through pixel centres.
constexpr const char* smallScene = R"(# A box over a slab, for checks.
title = "Small"
size = [48, 40]
camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }
light = { kind = "point", centre = [1.7, 6.1, -2.3] }
[timeline]
still = 2
moving = 0
[[object]]
mesh = { box = { size = [12, 0.2, 12] } }
place = [{ at = [0, -0.1, 0] }]
[[object]]
mesh = { box = { size = [1.6, 0.4, 1.2] } }
place = [{ at = [0.13, 1.2, 0.21] }]
)";

struct LightCase {
    std::string name;
    Light light;
};

/// Those that a technique with such an answer answers for.
std::vector<LightCase> lightsFor(Answer answer) {
    const glm::dvec3 place(1.7, 6.1, -2.3);
    if (answer == Answer::Soft)
        return {{"a rectangle", {LightKind::Rectangle, place, {0, -1, 0}, {1, 0, 0.1}, {-0.1, 0, 1}}},
                {"a disk", {LightKind::Disk, place, {0, -1, 0}, {0.8, 0, 0}, {0, 0, 0.8}}}};
    return {{"a point light", {LightKind::Point, place, {0, -1, 0}, {}, {}}},
            {"a directional light", {LightKind::Directional, place, glm::normalize(glm::dvec3(-0.3, -1, 0.4)), {}, {}}}};
}

Scene sceneUnder(const Light& light) {
    Scene scene = parseScene(smallScene, "check.toml", Profile::Gate);
    scene.light = light;
    return scene;
}

Scene withLightAt(Scene scene, const glm::dvec3& place) {
    scene.light.centre = place;
    scene.light.direction = glm::normalize(scene.camera.target - place);
    return scene;
}

Scene behindCamera(const Scene& scene) {
    return withLightAt(scene, scene.camera.eye + 0.6 * (scene.camera.eye - scene.camera.target));
}

/// Nothing that the camera sees is turned to it.
Scene behindAll(const Scene& scene) { return withLightAt(scene, {0.4, -7.1, 0.3}); }

/// Without the box.
Scene floorAlone(Scene scene) {
    scene.objects.pop_back();
    return scene;
}

Scene awayFromAll(Scene scene) {
    scene.camera.target = 2.0 * scene.camera.eye - scene.camera.target;
    return scene;
}

Scene ofOnePixel(Scene scene) {
    scene.size = {1, 1};
    return scene;
}

/// What a technique has drawn, of the pixels that see something alone: no other is ever scored.
using Values = std::vector<float>;

Values seenOf(const Stage& stage) {
    const Image<float> image = stage.visibility();
    const metrics::Drawn drawn = stage.drawn();
    Values seen;
    for (std::size_t i = 0; i < image.size(); ++i)
        if (drawn.id[i] != 0) seen.push_back(image[i]);
    return seen;
}

/// Two frames at rest, one in which light and casters are elsewhere, and one in which they have come back.
Values framesOf(const Scene& scene, const Variant& variant) {
    Stage stage(scene);
    const auto technique = variant.entry->make(variant.parameters);
    const Snapshot standing = snapshot(scene, 1);
    Values all;
    for (int frame = 0; frame < 4; ++frame) {
        stage.show(frame < 2    ? standing
                   : frame == 2 ? displaced(standing, Casters::Move)
                                : returned(standing, Casters::Move));
        stage.render(*technique, frame, 1);
        std::ranges::copy(seenOf(stage), std::back_inserter(all));
    }
    return all;
}

std::string outOfRange(const Values& values) {
    for (const float v : values) {
        if (std::isnan(v)) return "a pixel's visibility is NaN, of a division of 0 by 0 or the like";
        if (v < 0 || v > 1) return fmt::format("a pixel has the visibility {}, which is not within 0 and 1", v);
    }
    return "";
}

std::string drawnTwice(const Scene& scene, const Variant& variant) {
    const Values first = framesOf(scene, variant), second = framesOf(scene, variant);
    if (std::string wrong = outOfRange(first); !wrong.empty()) return wrong;
    const auto differ = [](float a, float b) { return std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b); };
    const int others = std::inner_product(first.begin(), first.end(), second.begin(), 0, std::plus<>(), differ);
    return others == 0 ? "" : fmt::format("of {} pixels {} differ when they are drawn again", first.size(), others);
}

/// A hundredth of the pixels may be wrong, as where rays graze.
std::string litAlone(const Scene& scene, const Variant& variant) {
    const Values values = framesOf(scene, variant);
    if (std::string wrong = outOfRange(values); !wrong.empty()) return wrong;
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    return mean >= 0.99 ? "" : fmt::format("{:.1f} % of the light is missing on a floor by itself", 100 * (1 - mean));
}

std::string inRange(const Scene& scene, const Variant& variant) { return outOfRange(framesOf(scene, variant)); }

using Draw = std::string (*)(const Scene&, const Variant&);

RowCheck checkOf(std::string what, Draw draw, Scene scene, Variant variant) {
    return {std::move(what), [draw, scene = std::move(scene), variant] { return draw(scene, variant); }};
}

void addChecksOfRow(const Variant& variant, std::vector<RowCheck>& checks) {
    for (const LightCase& light : lightsFor(variant.entry->answer)) {
        const Scene scene = sceneUnder(light.light);
        const auto add = [&](const std::string& what, Draw draw, Scene changed) {
            checks.push_back(
                checkOf(fmt::format("{} under {}: {}", variant.name, light.name, what), draw, std::move(changed), variant));
        };
        add("the same bits twice", drawnTwice, scene);
        add("the light is behind the camera", inRange, behindCamera(scene));
        add("the light is behind all", inRange, behindAll(scene));
        add("nothing casts a shadow", litAlone, floorAlone(scene));
        add("the camera sees nothing", inRange, awayFromAll(scene));
        add("an image of one pixel", inRange, ofOnePixel(scene));
    }
}

std::vector<std::string> endsOf(const techniques::Domain& domain) {
    if (const auto* range = std::get_if<techniques::IntegerRange>(&domain))
        return {std::to_string(range->low), std::to_string(range->high)};
    if (const auto* range = std::get_if<techniques::RealRange>(&domain))
        return {fmt::format("{}", range->low), fmt::format("{}", range->high)};
    return std::get<techniques::OneOf>(domain).values;
}

} // namespace

std::vector<RowCheck> rowChecks(const Entry& entry) {
    std::vector<RowCheck> checks;
    for (const std::string& parameters : entry.variants)
        addChecksOfRow(techniques::parseVariant(parameters.empty() ? entry.id : entry.id + ":" + parameters), checks);
    const Scene scene = sceneUnder(lightsFor(entry.answer).front().light);
    for (const techniques::Parameter& parameter : entry.parameters)
        for (const std::string& end : endsOf(parameter.domain))
            checks.push_back(checkOf(fmt::format("{} at {} = {}", entry.id, parameter.name, end), inRange, scene,
                                     techniques::parseVariant(fmt::format("{}:{}={}", entry.id, parameter.name, end))));
    return checks;
}

} // namespace shadowbench::gate
