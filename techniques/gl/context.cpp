#include "techniques/gl/context.h"

#include "base/error.h"
#include "techniques/gl/api.h"
#include "techniques/gl/contexts_made.h"
#include "techniques/gl/functions.h"
#include "techniques/gl/make_context.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <malloc.h>
#include <string_view>

namespace shadowbench::gl {
namespace {

// GL's own notion of "current" is per thread and hidden; this is the same thing, visible.
thread_local Context* currentContext = nullptr;

/// The contexts that this process has: two of different platforms would share one table of functions.
struct Living {
    int contexts = 0;
    Platform platform = Platform::Auto;
};
thread_local Living living;

std::atomic<int> made = 0;

} // namespace

void noteMessage(Context& context, unsigned type, const char* message) {
    if (type == GL_DEBUG_TYPE_ERROR && context.firstError_.empty()) context.firstError_ = message;
}

namespace {

void APIENTRY onMessage(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei /*length*/,
                        const GLchar* message, const void* context) {
    noteMessage(*static_cast<Context*>(const_cast<void*>(context)), type, message);
}

std::string text(GLenum what) {
    const GLubyte* found = glGetString(what);
    return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

int number(GLenum what) {
    GLint found = 0;
    glGetIntegerv(what, &found);
    return found;
}

bool isSoftware(const std::string& renderer) {
    constexpr std::array<std::string_view, 3> rasterisers{"llvmpipe", "softpipe", "swr"};
    return std::ranges::any_of(rasterisers, [&](std::string_view name) { return renderer.starts_with(name); });
}

/// As Mesa reads it, so that one variable says it to both.
bool isSoftwareAskedFor() {
    constexpr std::array<std::string_view, 6> no{"", "0", "n", "no", "f", "false"};
    const char* word = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return word != nullptr && std::ranges::find(no, std::string_view(word)) == no.end();
}

/// OSMesa where it opens, else EGL without a graphics processor.
std::unique_ptr<Context> makeSoftwareContext(const ContextOptions& options) {
    if (osMesaLibrary().whyNot().empty()) return makeOsMesaContext(options);
    if (eglLibrary().whyNot().empty()) return makeEglContext(options, true);
    throw Inconclusive("there is no OpenGL to draw with: neither OSMesa (" + osMesaLibrary().whyNot() + ") nor EGL (" +
                       eglLibrary().whyNot() + "); install one of them with: apt-get install libosmesa6");
}

} // namespace

std::string driverOf(const std::string& version) {
    // "major.minor[.release] [(profile)] driver"
    std::size_t at = version.find(' ');
    if (at != std::string::npos && version.compare(at, 2, " (") == 0) at = version.find(") ", at);
    if (at == std::string::npos) return "";
    return version.substr(version.find_first_not_of(") ", at));
}

std::unique_ptr<Context> Context::create(const ContextOptions& options) {
    switch (options.platform) {
    case Platform::OsMesa:
        return makeOsMesaContext(options);
    case Platform::Egl:
        return makeEglContext(options, isSoftwareAskedFor());
    default:
        return makeSoftwareContext(options);
    }
}

Context::Context(Platform platform, const ContextOptions& options)
    : info_{.platform = platform, .rasterThreads = options.rasterThreads, .vectorBits = options.vectorBits} {
    if (living.contexts > 0 && living.platform != platform)
        throw InternalError("a context of " + std::string(name(platform)) + " was asked for beside one of " +
                            std::string(name(living.platform)));
    ++living.contexts;
    ++made;
    living.platform = platform;
}

int contextsMade() { return made; }

Context::~Context() { --living.contexts; }

Context& Context::current() {
    if (currentContext == nullptr) throw InternalError("no OpenGL context is current on this thread");
    return *currentContext;
}

void Context::becomeCurrent(bool debug, const std::function<void*(const char* name)>& findFunction) {
    loadFunctions("the OpenGL of " + std::string(name(info_.platform)), findFunction);
    info_.vendor = text(GL_VENDOR);
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    info_.driver = driverOf(info_.version);
    info_.software = isSoftware(info_.renderer);
    if (!info_.software) info_.rasterThreads = info_.vectorBits = 0;
    if (10 * number(GL_MAJOR_VERSION) + number(GL_MINOR_VERSION) < 45)
        throw Inconclusive("drawing needs OpenGL 4.5; " + info_.renderer + " has " + info_.version);
    currentContext = this;
    if (!debug) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, this);
}

void Context::ceaseCurrent() { currentContext = nullptr; }

unsigned Context::noAttributes() {
    if (noAttributes_ == 0) glGenVertexArrays(1, &noAttributes_);
    return noAttributes_;
}

void Context::finish() { glFinish(); }

void Context::discardErrors() {
    glGetError();
    firstError_.clear();
}

void Context::check(const std::string& doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR && firstError_.empty()) return;
    const std::string reason = firstError_.empty() ? "GL error " + std::to_string(error) : firstError_;
    firstError_.clear();
    throw InternalError(doing + ": " + reason);
}

void fixRasteriser(const ContextOptions& options) {
    // Textures are blocks of megabytes, which come and go with each technique. If they went back to the kernel, it would map
    // and clear each of their pages anew.
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", std::to_string(options.rasterThreads).c_str(), 1);
    setenv("LP_NATIVE_VECTOR_WIDTH", std::to_string(options.vectorBits).c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", options.shaderCache.empty() ? "true" : "false", 1);
    if (!options.shaderCache.empty()) setenv("MESA_SHADER_CACHE_DIR", options.shaderCache.c_str(), 1);
}

} // namespace shadowbench::gl
