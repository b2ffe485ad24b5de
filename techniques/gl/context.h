// The OpenGL 4.5 core context. One per process at a time, current on the thread that made it: GL is built that way, and
// everything under techniques/ relies on it.
#pragma once

#include "techniques/gl/counters.h"
#include "techniques/gl/framebuffers.h"

#include <memory>
#include <string>

namespace shadowbench::gl {

struct ContextOptions {
    int rasterThreads = 0;   // 0: raster on the calling thread (the reproducible setting)
    int vectorBits = 256;    // native vector width of the software rasteriser
    bool debug = false;      // GL messages of type error become exceptions at the next `check`
    std::string shaderCache; // folder of machine code that contexts and processes share; empty: each compiles its own
};

/// What the records' environment block says about the rasteriser.
struct ContextInfo {
    std::string renderer; // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string version;  // "4.5 (Core Profile) Mesa 22.3.6"
    int rasterThreads;
    int vectorBits;
};

class Context {
public:
    /// Sets the rasteriser's environment variables, then makes the context current. Throws Inconclusive without OpenGL 4.5.
    static std::unique_ptr<Context> create(const ContextOptions& options = {});
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// The context that is current; throws InternalError when there is none.
    static Context& current();

    [[nodiscard]] const ContextInfo& info() const { return info_; }
    [[nodiscard]] Tally& tally() { return tally_; }
    [[nodiscard]] Framebuffers& framebuffers() { return framebuffers_; }

    /// A vertex array without attributes: what full-screen passes draw from.
    [[nodiscard]] unsigned noAttributes();

    /// A GL function that the library does not export by name.
    [[nodiscard]] virtual void* function(const char* name) const = 0;

    /// Waits until everything submitted is done.
    void finish();

    /// Throws InternalError naming `doing` if GL has reported an error since the last check.
    void check(const std::string& doing);

    /// Forgets reported errors: for a caller that has just thrown a better sentence.
    void discardErrors();

protected:
    explicit Context(int rasterThreads, int vectorBits) : info_{"", "", rasterThreads, vectorBits} {}
    /// Reads the info and installs the debug callback; to be called by a derived class once it is current.
    void becomeCurrent(bool debug);
    void ceaseCurrent();

private:
    ContextInfo info_;
    Tally tally_;
    Framebuffers framebuffers_; // end with the context, as the vertex array does
    unsigned noAttributes_ = 0;
    std::string firstError_;
    friend void noteMessage(Context&, unsigned type, const char* message);
};

} // namespace shadowbench::gl
