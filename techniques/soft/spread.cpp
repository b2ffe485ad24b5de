#include "techniques/soft/spread.h"

#include <cmath>
#include <numbers>

namespace shadowbench::techniques {

Parameter spreadParameter(const char* byDefault, const char* source) {
    return {"spread", byDefault, OneOf{{"smoothing", "distance"}},
            "from the outlines of casters, a pass at a time: the mean of the neighbourhood, or the distance", source};
}

bool isSmoothed(const Parameters& parameters) { return parameters.text("spread") == "smoothing"; }

double spreadReach(int passes, bool smoothed) { return smoothed ? std::sqrt(std::numbers::pi * passes / 3) : passes; }

} // namespace shadowbench::techniques
