// The OpenGL 4.5 core context. One per process at a time, current on the thread that made it: GL is built that way, and
// everything under techniques/ relies on it. A process that is forked makes its own.
#pragma once

#include "techniques/gl/counters.h"
#include "techniques/gl/framebuffers.h"
#include "techniques/gl/platform.h"

#include <functional>
#include <memory>
#include <set>
#include <string>

namespace shadowbench::gl {

struct ContextOptions {
    int rasterThreads = 0;   // 0: raster on the calling thread (the reproducible setting)
    int vectorBits = 256;    // native vector width of the software rasteriser
    bool debug = false;      // GL messages of type error become exceptions at the next `check`
    std::string shaderCache; // folder of machine code that contexts and processes share; empty: each compiles its own
    Platform platform = chosenPlatform();
};

/// What the records' environment block says about the rasteriser.
struct ContextInfo {
    Platform platform = Platform::Auto; // never Auto once the context is made
    std::string vendor = {};            // "Mesa/X.org", "NVIDIA Corporation"
    std::string renderer = {};          // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string version = {};           // "4.5 (Core Profile) Mesa 22.3.6"
    std::string driver = {};            // of that version: "Mesa 22.3.6", "NVIDIA 550.54.15"
    bool software = true;               // else the next two are 0
    int rasterThreads = 0;
    int vectorBits = 0;
};

class Context {
public:
    /// Sets the rasteriser's environment variables, then makes the context current. Throws Inconclusive, saying what to
    /// install, without OpenGL 4.5, and InternalError beside a context of another platform.
    static std::unique_ptr<Context> create(const ContextOptions& options = {});
    virtual ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// The context that is current; throws InternalError when there is none.
    static Context& current();

    [[nodiscard]] const ContextInfo& info() const { return info_; }
    [[nodiscard]] Tally& tally() { return tally_; }
    [[nodiscard]] Framebuffers& framebuffers() { return framebuffers_; }

    /// Files of which the shaders consist that were compiled so far: what is drawn depends on no others.
    [[nodiscard]] std::set<std::string>& shaderFiles() { return shaderFiles_; }

    /// A vertex array without attributes: what full-screen passes draw from.
    [[nodiscard]] unsigned noAttributes();

    /// Waits until everything submitted is done.
    void finish();

    /// Throws InternalError naming `doing` if GL has reported an error since the last check.
    void check(const std::string& doing);

    /// Forgets reported errors: for a caller that has just thrown a better sentence.
    void discardErrors();

protected:
    Context(Platform platform, const ContextOptions& options);
    /// Fills the table of functions and the info, and installs the debug callback; to be called by a derived class once it
    /// is current. Throws Inconclusive, having ceased to be current, if it has less than OpenGL 4.5.
    void becomeCurrent(bool debug, const std::function<void*(const char* name)>& findFunction);
    void ceaseCurrent();

private:
    ContextInfo info_;
    Tally tally_;
    Framebuffers framebuffers_; // end with the context, as the vertex array does
    std::set<std::string> shaderFiles_;
    unsigned noAttributes_ = 0;
    std::string firstError_;
    friend void noteMessage(Context&, unsigned type, const char* message);
};

/// "Mesa 22.3.6" of "4.5 (Core Profile) Mesa 22.3.6", "NVIDIA 550.54.15" of "4.6.0 NVIDIA 550.54.15".
std::string driverOf(const std::string& version);

} // namespace shadowbench::gl
