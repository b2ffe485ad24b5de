#include "techniques/contract/applicability.h"

#include "techniques/contract/entry.h"

#include <fmt/format.h>
#include <string_view>

namespace shadowbench::techniques {
namespace {

std::string_view describe(LightKind kind) {
    switch (kind) {
    case LightKind::Point:
        return "a point";
    case LightKind::Directional:
        return "directional";
    case LightKind::Rectangle:
        return "a rectangle";
    case LightKind::Disk:
        return "a disk";
    case LightKind::Line:
        return "a line";
    case LightKind::Environment:
        return "an environment";
    }
    return "";
}

} // namespace

std::optional<std::string> lightWithoutAnswer(const Scene& scene, const Entry& entry) {
    const auto needs = [&](std::string_view light) {
        return fmt::format("needs {}; the light of {} is {}", light, scene.id, describe(scene.light.kind));
    };
    const bool soft = entry.answer == Answer::Soft;
    if (scene.light.isEnvironment()) {
        if (entry.environment != EnvironmentAnswer::None) return std::nullopt;
        return needs(soft ? "an area light" : "a light in one place or direction");
    }
    if (entry.environment == EnvironmentAnswer::Only) return needs("an environment light");
    if (soft && !scene.light.isArea()) return needs("an area light");
    return std::nullopt;
}

std::optional<std::string> lightWithoutPosition(const Scene& scene) {
    if (scene.light.kind != LightKind::Directional) return std::nullopt;
    return fmt::format("needs a light with a position; the light of {} is directional", scene.id);
}

std::optional<std::string> lightWithoutArea(const Scene& scene) {
    if (scene.light.kind != LightKind::Line) return std::nullopt;
    return fmt::format("needs a light with a width and a height; the light of {} is a line", scene.id);
}

} // namespace shadowbench::techniques
