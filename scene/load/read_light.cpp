#include "scene/load/scene_file.h"
#include "scene/scene.h"
#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench {
namespace {

LightKind readKind(const TomlValue& value) {
    const std::vector<LightKind> kinds{LightKind::Point, LightKind::Directional, LightKind::Rectangle,
                                       LightKind::Disk,  LightKind::Line,        LightKind::Environment};
    std::vector<std::string> names;
    for (const LightKind kind : kinds) names.emplace_back(name(kind));
    const std::string word = value.oneOf(names);
    return kinds[static_cast<std::size_t>(std::find(names.begin(), names.end(), word) - names.begin())];
}

/// A light that is somewhere, or a directional one.
void readLocalLight(const TomlValue& value, Scene& scene) {
    Light& light = scene.light;
    const bool directional = light.kind == LightKind::Directional;
    const std::string moved = directional ? "direction" : "centre";
    std::vector<std::string> known{"kind", moved, "path"};
    if (light.isArea()) known.emplace_back("u");
    if (light.isArea() && light.kind != LightKind::Line) known.emplace_back("v");
    value.only(known);

    if (directional)
        light.direction = readDirection(value.get("direction"));
    else
        light.centre = value.get("centre").vector();
    if (light.isArea()) light.u = value.get("u").vector();
    if (light.isArea() && light.kind != LightKind::Line) light.v = value.get("v").vector();
    if (const auto path = value.find("path")) {
        for (const TomlValue& key : path->list()) key.only({"frame", moved});
        (directional ? scene.lightDirection : scene.lightCentre) = readTrack(*path, moved);
    }
}

} // namespace

glm::dvec3 readDirection(const TomlValue& value) {
    constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon(); // of a squared length, at most
    const glm::dvec3 direction = value.vector();
    if (!(glm::length(direction) > 0)) value.fail("expected a vector other than zero");
    if (std::abs(glm::dot(direction, direction) - 1) <= kRounding) return direction;
    return glm::normalize(direction);
}

void readLight(const TomlValue& value, const std::filesystem::path& folder, Scene& scene) {
    value.only({"kind", "centre", "direction", "u", "v", "path", "sky", "suns"});
    scene.light.kind = readKind(value.get("kind"));
    if (scene.light.isEnvironment())
        scene.light = environmentLight(readEnvironment(value.only({"kind", "sky", "suns"}), folder));
    else
        readLocalLight(value, scene);
}

} // namespace shadowbench
