#include "techniques/environment/static_scene.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {

std::optional<std::string> movingSurfaces(const Scene& scene) {
    const auto moving = std::ranges::find_if(scene.objects, [](const Object& object) { return !object.motion.still(); });
    if (moving == scene.objects.end()) return std::nullopt;
    return fmt::format("precomputes the transfer of surfaces that stand still; in {} one moves", scene.id);
}

} // namespace shadowbench::techniques
