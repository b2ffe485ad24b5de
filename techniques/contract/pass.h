// Named passes of a frame: what a GPU profiler shows as a group, and what the harness times and counts by itself.
#pragma once

#include <string_view>

namespace shadowbench::techniques {

/// Learns of the passes of a frame as they begin and end.
class PassListener {
public:
    virtual ~PassListener() = default;
    virtual void begin(std::string_view pass) = 0;
    virtual void end(std::string_view pass) = 0;
};

/// A part of a frame by the name that the field has for it ("depth map", "blur", "resolve"), from its construction to its
/// destruction. Work of the CPU belongs to it as draws do. Passes do not nest, so that those of a frame add up: the
/// listeners of harness/measure/pass_cost.h refuse a pass within another.
class Pass {
public:
    /// `name` must outlive the pass. `listener` may be null.
    Pass(std::string_view name, PassListener* listener);
    ~Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

private:
    std::string_view name_;
    PassListener* listener_;
};

} // namespace shadowbench::techniques
