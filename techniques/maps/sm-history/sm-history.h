// The arithmetic of pixel-correct shadow maps, free of GL (EGSR paper, section 3; Scherzer chapter 3).
#pragma once

#include <glm/vec2.hpp>

namespace shadowbench::techniques {

/// Eq. 3.6: 1 − 2 · max-norm distance to the nearest texel centre; `texel` is the map position in texels. In [0, 1].
double confidence(glm::dvec2 texel);

/// Eq. 3.7 and 3.3: s(n) = w f + (1 − w) s(n−1) with w = confidence^m.
double smoothed(double previous, double current, double confidence, double m);

/// The seed's schedule (section 4): m while moving, plus `step` for each frame that the camera stands still.
class MSchedule {
public:
    MSchedule(double m, double step) : start_(m), step_(step), m_(m) {}
    double next(bool moved);
    void reset() { *this = MSchedule(start_, step_); }

private:
    double start_, step_, m_;
    bool first_ = true;
};

} // namespace shadowbench::techniques
