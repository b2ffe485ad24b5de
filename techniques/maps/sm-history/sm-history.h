// How fast the history of pixel-correct shadow maps converges, free of GL (EGSR paper, section 4).
#pragma once

namespace shadowbench::techniques {

/// The exponent m of the confidence, frame by frame: `m` while the camera moves, `step` more for each frame that it stands
/// still.
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
