#include "studies/sweep/axis.h"

#include "base/error.h"
#include "base/words.h"
#include "scene/sky.h"
#include "studies/sweep/tessellate.h"
#include "studies/sweep/variants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace shadowbench {
namespace {

/// A direction as seen from the point that the camera looks at: a unit vector in the ground plane, and the angle above it.
struct Bearing {
    glm::dvec3 horizontal;
    double elevation; // radians
};

Bearing bearingOf(const glm::dvec3& direction, const Scene& scene, const char* whose) {
    const glm::dvec3 flat(direction.x, 0, direction.z);
    if (glm::length(flat) < 1e-6 * glm::length(direction))
        throw BadInput(fmt::format("the {} of scene {} is straight above what the camera looks at, so it has no bearing to "
                                   "turn; choose another axis or scene",
                                   whose, scene.id));
    return {glm::normalize(flat), std::atan2(direction.y, glm::length(flat))};
}

glm::dvec3 directionOf(const Bearing& bearing) {
    return std::cos(bearing.elevation) * bearing.horizontal + std::sin(bearing.elevation) * glm::dvec3(0, 1, 0);
}

/// From what the camera looks at to the light.
glm::dvec3 towardsLight(const Scene& scene) {
    if (scene.light.isEnvironment())
        throw BadInput(
            fmt::format("the light of scene {} is an environment, all around; choose another axis or scene", scene.id));
    if (scene.light.kind == LightKind::Directional) return -scene.light.direction;
    return scene.light.centre - scene.camera.target;
}

/// Puts the light into unit direction `to`, as far away as it is; an area light keeps its face towards the scene.
void turnLight(Scene& scene, const glm::dvec3& to) {
    Light& light = scene.light;
    if (light.kind == LightKind::Directional) {
        light.direction = -to;
        return;
    }
    const glm::dvec3 offset = towardsLight(scene), from = glm::normalize(offset);
    light.centre = scene.camera.target + glm::length(offset) * to;
    const glm::dvec3 axis = glm::cross(from, to);
    if (glm::length(axis) < 1e-12) return;
    const double angle = std::atan2(glm::length(axis), glm::dot(from, to));
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), angle, glm::normalize(axis));
    light.u = glm::dvec3(turn * glm::dvec4(light.u, 0));
    light.v = glm::dvec3(turn * glm::dvec4(light.v, 0));
}

Bearing eyeBearing(const Scene& scene) { return bearingOf(scene.camera.eye - scene.camera.target, scene, "camera"); }

void setLightViewAngle(Scene& scene, double degrees) {
    const Bearing eye = eyeBearing(scene);
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0));
    turnLight(scene, directionOf({glm::dvec3(turn * glm::dvec4(eye.horizontal, 0)), eye.elevation}));
}

void setLightElevation(Scene& scene, double degrees) {
    const Bearing light = bearingOf(towardsLight(scene), scene, "light");
    turnLight(scene, directionOf({light.horizontal, glm::radians(degrees)}));
}

/// The light is then as high as what the camera looks at.
double widestFacingAngle(const Scene& scene) { return 180 - glm::degrees(eyeBearing(scene).elevation); }

void setFacingAngle(Scene& scene, double degrees) {
    const double widest = widestFacingAngle(scene);
    if (degrees < 0 || degrees > widest)
        throw BadInput(
            fmt::format("the axes of camera and light of scene {} can be 0° to {:.1f}° apart with the light above "
                        "what the camera looks at, not {:g}°",
                        scene.id, widest, degrees));
    turnLight(scene, directionOf({-eyeBearing(scene).horizontal, glm::radians(widest - degrees)}));
}

void setNearPlane(Scene& scene, double metres) {
    if (!(metres > 0) || metres >= scene.camera.far)
        throw BadInput(
            fmt::format("a near plane at {:g} m does not lie between the eye and the far plane of scene {} ({:g} m)", metres,
                        scene.id, scene.camera.far));
    scene.camera.near = metres;
}

void setLightSize(Scene& scene, double factor) {
    if (!scene.light.isArea())
        throw BadInput(fmt::format("the light of scene {} has no size, its kind is {}; choose a scene with an area light",
                                   scene.id, name(scene.light.kind)));
    if (!(factor > 0)) throw BadInput(fmt::format("a light of {:g} times its size has none; give factors above 0", factor));
    scene.light.u *= factor;
    scene.light.v *= factor;
}

/// What a sun brings stays the same.
void setSunSize(Scene& scene, double degrees) {
    if (!scene.light.isEnvironment() || scene.light.environment->suns.empty())
        throw BadInput(fmt::format("the light of scene {} has no sun; choose a scene with one", scene.id));
    if (!(degrees > 0) || degrees > 180)
        throw BadInput(fmt::format("a sun's diameter is more than 0° and at most 180°, not {:g}°", degrees));
    EnvironmentLight light = *scene.light.environment;
    for (Sun& sun : light.suns) {
        const double power = sun.radiance * sun.solidAngle();
        sun.diameter = degrees;
        sun.radiance = power / sun.solidAngle();
    }
    scene.light = environmentLight(std::move(light));
}

/// The first object is the ground.
double casters(const Scene& scene) {
    double count = 0;
    for (std::size_t i = 1; i < scene.objects.size(); ++i) count += static_cast<double>(scene.objects[i].instances.size());
    return count;
}

void setCasters(Scene& scene, double count) {
    if (!(count >= 0) || count > casters(scene))
        throw BadInput(fmt::format("scene {} has {:g} casters; {:g} were asked for", scene.id, casters(scene), count));
    auto left = static_cast<std::size_t>(count);
    for (std::size_t i = 1; i < scene.objects.size(); ++i) {
        std::vector<Instance>& instances = scene.objects[i].instances;
        instances.resize(std::min(instances.size(), left));
        left -= instances.size();
    }
    std::erase_if(scene.objects, [](const Object& object) { return object.instances.empty(); });
}

void setStillFrames(Scene& scene, double frames) {
    if (!(frames >= 1)) throw BadInput(fmt::format("{:g} still frames were asked for; one at least is scored", frames));
    scene.timeline.still = static_cast<int>(frames);
}

/// A history is then filled, with what it has seen on the way.
void setTurn(Scene& scene, double degrees) {
    constexpr int frames = 30;
    scene.timeline.approach = frames;
    scene.eye.keys.clear();
    scene.target.keys.clear();
    const glm::dvec3 view = scene.camera.target - scene.camera.eye;
    for (int frame = -frames; frame <= 0; ++frame) {
        const double left = glm::radians(degrees) * frame / frames;
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), left, glm::dvec3(0, 1, 0));
        scene.target.keys.push_back({static_cast<double>(frame), scene.camera.eye + glm::dvec3(turn * glm::dvec4(view, 0))});
    }
}

/// The track run through in reverse at `speed` times its pace, from its last key to where it is at rest, in frame 0. A track
/// that ends there, since the camera approaches, is run through as it is.
Track towardsRest(const Track& track, double speed) {
    Track result;
    const bool approaches = !track.keys.empty() && track.keys.front().frame < 0;
    for (const Track::Key& key : track.keys)
        if (!approaches || key.frame <= 0) result.keys.push_back({-std::abs(key.frame) / speed, key.value});
    if (!approaches) std::ranges::reverse(result.keys);
    return result;
}

/// The whole way is then one frame.
double fastestCamera(const Scene& scene) {
    double frames = 1;
    for (const Track* track : {&scene.eye, &scene.target})
        for (const Track::Key& key : track->keys) frames = std::max(frames, std::abs(key.frame));
    return frames;
}

/// The frame that is scored is the last of the way, and shows the same at every speed.
void setCameraSpeed(Scene& scene, double factor) {
    if (scene.eye.keys.empty() && scene.target.keys.empty())
        throw BadInput(fmt::format("the camera of scene {} stands still; choose a scene with a [camera] path, such as "
                                   "moving-camera",
                                   scene.id));
    if (!(factor > 0))
        throw BadInput(fmt::format("a camera at {:g} times its speed is none that moves; give factors above 0", factor));
    for (Track* track : {&scene.eye, &scene.target}) *track = towardsRest(*track, factor);
    scene.timeline.approach = 30;
    scene.timeline.still = 1;
}

/// Across the ground, along no axis of coordinates. Distances within the scene stay as they are, to the rounding of double
/// precision.
void setWorldOffset(Scene& scene, double metres) { translate(scene, metres * glm::dvec3(0.8, 0, -0.6)); }

void setAlphaCutoff(Scene& scene, double cutoff) {
    if (!(cutoff > 0) || cutoff >= 1)
        throw BadInput(fmt::format(
            "a cut-off of alpha lies between 0, where all is solid, and 1, where nothing is, not at {:g}", cutoff));
    bool found = false;
    for (Object& object : scene.objects)
        for (Level& level : object.levels) {
            if (!level.cutAt) continue;
            found = true;
            level.mesh = std::make_shared<const Mesh>(level.cutAt(cutoff));
            if (level.mesh->triangles.empty())
                throw BadInput(
                    fmt::format("a cut-off of {:g} leaves nothing of {} in scene {}", cutoff, object.name, scene.id));
        }
    if (!found)
        throw BadInput(fmt::format("no mesh of scene {} is cut out by an alpha test that can be moved; choose a scene with "
                                   "leaf_cards, such as alpha-foliage",
                                   scene.id));
}

/// A pool of square maps; the axis counts pages.
double mapOfPages(double pages, const techniques::Parameters& others) {
    const double side = std::sqrt(pages);
    if (side != std::floor(side))
        throw BadInput(fmt::format("a pool with a square map has a square number of pages, such as {:g} or {:g}, not {:g}",
                                   std::pow(std::floor(side), 2), std::pow(std::ceil(side), 2), pages));
    return side * others.integer("page");
}

/// Of the newest frame in a mean whose memory is so many frames long.
double shareOf(double frames, const techniques::Parameters&) { return 1 / frames; }

/// Shapes stay the same, so the truth does.
void setTessellation(Scene& scene, double times) {
    if (times < 0 || times > 6) throw BadInput(fmt::format("triangles can be quartered 0 to 6 times, not {:g}", times));
    const auto refine = [&](std::shared_ptr<const Mesh>& mesh) {
        mesh = std::make_shared<const Mesh>(quartered(*mesh, static_cast<int>(times)));
    };
    for (Object& object : scene.objects) {
        for (Level& level : object.levels) refine(level.mesh);
        for (auto& pose : object.poses) refine(pose);
        if (!object.poses.empty()) object.levels.front().mesh = object.poses.front();
    }
}

const std::array allAxes{
    Axis{"light-view-angle",
         "°",
         "bearing of the light about what the camera looks at, at the camera's own elevation: 0 is a miner's headlamp, 180 "
         "dueling frusta",
         {0, 15, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165, 180},
         false,
         false,
         setLightViewAngle},
    Axis{"facing-angle",
         "°",
         "angle between the camera's axis and the light's, both to what the camera looks at, with the light behind that: 0 "
         "is "
         "a miner's headlamp, 180 dueling frusta; the camera stays, the light sinks",
         {90, 105, 120, 139, 150, 160, 168, 172},
         false,
         false,
         setFacingAngle,
         widestFacingAngle},
    Axis{"light-elevation",
         "°",
         "elevation of the light above what the camera looks at",
         {85, 75, 60, 45, 30, 20, 15, 10, 7, 5},
         false,
         false,
         setLightElevation},
    Axis{"near-plane",
         "m",
         "distance of the camera's near plane",
         {1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001},
         true,
         false,
         setNearPlane},
    Axis{"light-size",
         "×",
         "size of an area light as a multiple of the scene's own",
         {0.125, 0.25, 0.5, 1, 1.5, 2},
         true,
         false,
         setLightSize},
    Axis{"sun-size",
         "°",
         "angular diameter of the suns of an environment light, which bring the same whatever it is",
         {40, 20, 5},
         true,
         false,
         setSunSize},
    Axis{"casters",
         "",
         "number of casters, in the order of the scene file",
         {1, 2, 4, 8, 16, 32, 64, 128, 256},
         true,
         true,
         setCasters,
         casters},
    Axis{"tessellation",
         "",
         "how often every triangle is cut into four; the shapes stay the same",
         {4, 3, 2, 1, 0},
         false,
         true,
         setTessellation},
    Axis{"still-frames",
         "frames",
         "still frames, of which the last is scored: techniques that keep a history converge over them",
         {1, 2, 4, 8, 15, 30, 60, 120, 240},
         true,
         true,
         setStillFrames},
    Axis{"turn",
         "°",
         "angle by which the camera turns on the spot, in 30 frames before the still ones",
         {0, 3, 9, 30, 90},
         false,
         false,
         setTurn},
    Axis{"camera-speed",
         "×",
         "speed at which the camera comes along its path, from the end to the start, as a multiple of the scene's own; the "
         "frame in which it arrives is scored",
         {0.125, 0.25, 0.5, 1, 2, 4, 8},
         true,
         false,
         setCameraSpeed,
         fastestCamera},
    Axis{"world-offset",
         "m",
         "distance by which the whole scene is moved across the ground, away from where it was loaded",
         {10, 100, 1000, 2000, 4000, 8000, 16'000},
         true,
         false,
         setWorldOffset},
    Axis{"alpha-cutoff",
         "",
         "least alpha that is solid, of leaf_cards",
         {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
         false,
         false,
         setAlphaCutoff},
    Axis{.id = "map",
         .unit = "texels",
         .meaning = "side of the shadow map",
         .values = {4096, 2048, 1024, 512, 256, 128, 64},
         .logarithmic = true,
         .whole = true,
         .parameters = {{"*", "map"}}},
    Axis{.id = "units",
         .unit = "",
         .meaning =
             "constant depth bias of the shadow map (with bias=constant, or beside a slope bias), in 2⁻²⁴ of the depth "
             "range",
         .values = {0, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1048576, 4194304},
         .logarithmic = true,
         .parameters = {{"*", "units"}}},
    Axis{.id = "factor",
         .unit = "",
         .meaning = "slope depth bias of the shadow map, in depth slopes per texel",
         .values = {0, 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64},
         .parameters = {{"*", "factor"}}},
    Axis{.id = "cascades",
         .unit = "",
         .meaning = "number of cascades, which share the texels of one map",
         .values = {8, 6, 4, 3, 2, 1},
         .whole = true,
         .parameters = {{"*", "cascades"}, {"sm-*", "slices"}, {"sdsm", "slices"}}},
    Axis{.id = "page-budget",
         .unit = "",
         .meaning =
             "pages of a virtual shadow map that there is memory for (sm-clipmap), or that a frame uses (sm-adaptive), at "
             "most",
         .values = {1024, 256, 64, 16, 4, 1},
         .logarithmic = true,
         .whole = true,
         .parameters = {{"sm-clipmap", "map", mapOfPages}, {"*", "pages"}}},
    Axis{.id = "rays",
         .unit = "",
         .meaning = "rays a pixel and frame",
         .values = {16, 8, 4, 2, 1},
         .logarithmic = true,
         .whole = true,
         .parameters = {{"ray-*", "rays"}, {"my:*", "rays"}}},
    Axis{.id = "accumulation-length",
         .unit = "frames",
         .meaning = "memory of a mean over frames, of which the newest has one part in so many",
         .values = {32, 16, 8, 4, 2, 1},
         .logarithmic = true,
         .parameters = {{"accumulated", "share", shareOf}, {"ray-*", "share", shareOf}}},
};

} // namespace

std::vector<double> Axis::valuesFor(const Scene& scene) const {
    std::vector<double> result = values;
    if (!most) return result;
    std::erase_if(result, [largest = most(scene)](double value) { return value >= largest; });
    result.push_back(most(scene));
    return result;
}

const AxisParameter* Axis::parameterOf(const techniques::Variant& variant) const {
    const auto found = std::ranges::find_if(parameters, [&](const AxisParameter& parameter) {
        return fnmatch(parameter.techniques.c_str(), variant.entry->id.c_str(), 0) == 0 &&
               shadowbench::parameterOf(variant, parameter.name) != nullptr;
    });
    return found == parameters.end() ? nullptr : &*found;
}

techniques::Variant Axis::at(const techniques::Variant& variant, double value) const {
    const AxisParameter& parameter = *parameterOf(variant);
    const double own = parameter.of ? parameter.of(value, variant.parameters) : value;
    return withParameter(variant, parameter.name, fmt::format("{}", own));
}

std::span<const Axis> axes() { return allAxes; }

const Axis& axisNamed(std::string_view id) {
    std::vector<std::string> known;
    for (const Axis& axis : axes()) {
        if (axis.id == id) return axis;
        known.push_back(axis.id);
    }
    throw BadInput(fmt::format("unknown axis \"{}\"{}; known are {}", id, didYouMean(id, known), fmt::join(known, ", ")));
}

} // namespace shadowbench
