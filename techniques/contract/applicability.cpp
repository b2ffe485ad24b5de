#include "techniques/contract/applicability.h"

#include <fmt/format.h>

namespace shadowbench::techniques {

std::optional<std::string> lightWithoutPosition(const Scene& scene) {
    if (scene.light.kind != LightKind::Directional) return std::nullopt;
    return fmt::format("needs a light with a position; the light of {} is directional", scene.id);
}

} // namespace shadowbench::techniques
