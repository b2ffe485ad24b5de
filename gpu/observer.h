// Which pipelines a frame uses, seen from outside as a GPU debugger sees it: while an observer lives, it stands before the
// functions of OpenGL that draw, dispatch and group (techniques/gl/api.h), reads the state, and calls them. Otherwise
// nothing is in the way.
#pragma once

#include "gpu/pipeline.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace shadowbench::gpu {

/// A pipeline of a pass.
struct Use {
    std::string pass; // "" between passes
    Pipeline pipeline;
    std::uint64_t draws = 0; // and dispatches
};

/// One at a time, of the context that is current and outlives it.
class Observer {
public:
    Observer();
    ~Observer();
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;

    /// What was used since the last call, each pipeline of a pass once, in the order of its first use.
    std::vector<Use> take();

private:
    friend struct Hooks;
    void draw(unsigned topology);
    void dispatch();
    void note(Pipeline pipeline);

    std::string pass_;
    std::vector<Use> uses_;
    std::map<std::string, std::size_t> known_; // pass and digest → index in uses_
};

} // namespace shadowbench::gpu
