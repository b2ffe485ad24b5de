#include "techniques/soft/shadow-width-map/width_passes.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::techniques {

WidthPasses widthPasses(const glm::dvec2& texelReach, double widest, int most) {
    WidthPasses passes;
    passes.reachPerPass = std::min(texelReach.x, texelReach.y);
    const double needed = std::ceil(widest / passes.reachPerPass);
    const int count = static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(most)));
    const auto texelsAfter = [&](int pass) {
        return glm::ivec2(std::lround(pass * passes.reachPerPass / texelReach.x),
                          std::lround(pass * passes.reachPerPass / texelReach.y));
    };
    for (int pass = 0; pass < count; ++pass) passes.steps.push_back(texelsAfter(pass + 1) - texelsAfter(pass));
    return passes;
}

} // namespace shadowbench::techniques
