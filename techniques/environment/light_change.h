// Whether a light is another one than before.
#pragma once

#include "scene/camera.h"

#include <optional>

namespace shadowbench::techniques {

class LightChange {
public:
    /// Whether `light` differs from the one of the call before; of the first call, true.
    bool changesTo(const Light& light) {
        if (light_ == light) return false;
        light_ = light;
        return true;
    }

    /// The next call is the first.
    void forget() { light_.reset(); }

private:
    std::optional<Light> light_;
};

} // namespace shadowbench::techniques
