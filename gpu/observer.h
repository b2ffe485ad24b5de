// Which pipelines a frame uses, seen from outside as a GPU debugger sees it: while an observer lives, it stands before the
// functions of OpenGL that draw, dispatch and group (techniques/gl/api.h), reads the state, and calls them. Otherwise
// nothing is in the way.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/state.h"
#include "gpu/wave_passes.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench::gpu {

/// Width and height in pixels → how often.
using Extents = std::map<std::pair<int, int>, std::uint64_t>;

/// A pipeline of a pass.
struct Use {
    std::string pass; // "" between passes
    Pipeline pipeline;
    std::uint64_t draws = 0; // and dispatches
    Extents extents = {}; // of targets, each time that another one is drawn into; of each dispatch, invocations in x, y · z
    WavePasses passes = {}; // of its fragment or compute shader; empty where nothing counted
};

enum class MoveKind { Clear, Copy, Mipmap, ReadBack };

/// What a pass does beside draws and dispatches.
struct Move {
    std::string pass; // "" between passes
    MoveKind kind;
    unsigned format = 0; // OpenGL's, of the texture; 0: read back from a buffer
    Extents extents = {};
};

/// "clear", "copy", "mipmap", "read back".
std::string_view name(MoveKind kind);

/// Throws BadInput for another word.
MoveKind moveNamed(std::string_view word);

class Counter;

/// One at a time, of the context that is current and outlives it; `counter`, made before it, too.
class Observer {
public:
    explicit Observer(Counter* counter = nullptr);
    ~Observer();
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;

    /// What was used since the last call, each pipeline of a pass once, in the order of its first use.
    std::vector<Use> take();

    /// The same of clears, copies, mipmaps and read-backs.
    std::vector<Move> takeMoves();

private:
    friend struct Hooks;
    void draw(unsigned topology);
    void dispatch(unsigned x, unsigned y, unsigned z);
    Use& note(Pipeline pipeline, const std::string& key);
    [[nodiscard]] std::string keyOf(const Pipeline& pipeline) const;
    void move(MoveKind kind, const Target& target);

    Counter* counter_;
    std::string pass_;
    std::vector<Use> uses_;
    std::vector<Move> moves_;
    std::map<std::string, std::size_t> known_;                  // pass and digest → index in uses_
    using DrawnInto = std::pair<unsigned, std::pair<int, int>>; // OpenGL's framebuffer, and the viewport
    DrawnInto drawnInto_{};                                     // of the draw before in this pass
};

} // namespace shadowbench::gpu
