#include "techniques/contract/applicability.h"

#include <fmt/format.h>

namespace shadowbench::techniques {

std::optional<std::string> lightWithoutPosition(const Scene& scene) {
    if (scene.light.kind != LightKind::Directional) return std::nullopt;
    return fmt::format("needs a light with a position; the light of {} is directional", scene.id);
}

std::optional<std::string> lightWithoutArea(const Scene& scene) {
    if (scene.light.kind != LightKind::Line) return std::nullopt;
    return fmt::format("needs a light with a width and a height; the light of {} is a line", scene.id);
}

} // namespace shadowbench::techniques
