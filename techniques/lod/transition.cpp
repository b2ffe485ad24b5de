#include "techniques/lod/transition.h"

#include <algorithm>

namespace shadowbench::techniques {

TransitionVisibility transitionVisibility(double progress) {
    return {std::min(1.0, 2 - 2 * progress), std::min(1.0, 2 * progress)};
}

bool showsCoarser(double progress) { return progress >= 0.5; }

} // namespace shadowbench::techniques
