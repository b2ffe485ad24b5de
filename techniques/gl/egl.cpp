// Everything that knows EGL: a graphics processor by EGL_EXT_platform_device, Mesa's rasteriser in software by
// EGL_MESA_platform_surfaceless. Neither has a window; all drawing goes to framebuffer objects.
#include "base/error.h"
#include "techniques/gl/make_context.h"

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <sstream>
#include <utility>
#include <vector>

#define EGL_NO_X11 // no types of a window system
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace shadowbench::gl {
namespace {

constexpr const char* packages = "install it with: apt-get install libegl1 libgl1-mesa-dri";

struct Functions {
    PFNEGLGETPROCADDRESSPROC find;
    PFNEGLQUERYSTRINGPROC queryString;
    PFNEGLGETERRORPROC error;
    PFNEGLGETPLATFORMDISPLAYPROC display;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLTERMINATEPROC terminate;
    PFNEGLBINDAPIPROC bindApi;
    PFNEGLCREATECONTEXTPROC createContext;
    PFNEGLDESTROYCONTEXTPROC destroyContext;
    PFNEGLMAKECURRENTPROC makeCurrent;
};

Functions functionsOf(const Library& library) {
    if (!library.whyNot().empty())
        throw Inconclusive("drawing through EGL failed: " + library.whyNot() + "; " + packages +
                           ", or draw with OSMesa with --gl osmesa");
    return {library.function<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress"),
            library.function<PFNEGLQUERYSTRINGPROC>("eglQueryString"),
            library.function<PFNEGLGETERRORPROC>("eglGetError"),
            library.function<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay"),
            library.function<PFNEGLINITIALIZEPROC>("eglInitialize"),
            library.function<PFNEGLTERMINATEPROC>("eglTerminate"),
            library.function<PFNEGLBINDAPIPROC>("eglBindAPI"),
            library.function<PFNEGLCREATECONTEXTPROC>("eglCreateContext"),
            library.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext"),
            library.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")};
}

bool hasExtension(const char* extensions, std::string_view name) {
    std::istringstream words(extensions == nullptr ? "" : extensions);
    for (std::string word; words >> word;)
        if (word == name) return true;
    return false;
}

/// The devices that are graphics processors, in EGL's order; none where EGL does not list devices.
std::vector<EGLDeviceEXT> graphicsProcessors(const Functions& egl) {
    const char* extensions = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool listed =
        hasExtension(extensions, "EGL_EXT_device_base") ||
        (hasExtension(extensions, "EGL_EXT_device_enumeration") && hasExtension(extensions, "EGL_EXT_device_query"));
    if (!listed || !hasExtension(extensions, "EGL_EXT_platform_device")) return {};
    const auto list = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.find("eglQueryDevicesEXT"));
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.find("eglQueryDeviceStringEXT"));
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (list == nullptr || query == nullptr ||
        list(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE)
        return {};
    std::vector<EGLDeviceEXT> processors;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        if (!hasExtension(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) processors.push_back(device);
    }
    return processors;
}

/// A display with a context of its own; both end with it.
class Session {
public:
    /// Throws Inconclusive, saying what failed.
    Session(const Functions& egl, EGLenum platform, void* device, bool debug) : egl_(egl) {
        display_ = egl_.display(platform, device, nullptr);
        if (display_ == EGL_NO_DISPLAY) fail("finding a display");
        if (egl_.initialize(display_, nullptr, nullptr) == EGL_FALSE) fail("opening the display");
        open_ = true;
        for (const char* name : {"EGL_KHR_create_context", "EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"})
            if (!hasExtension(egl_.queryString(display_, EGL_EXTENSIONS), name)) lacks(name);
        if (egl_.bindApi(EGL_OPENGL_API) == EGL_FALSE) fail("choosing OpenGL");
        const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               4,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_CONTEXT_OPENGL_DEBUG,
                                               debug ? EGL_TRUE : EGL_FALSE,
                                               EGL_NONE};
        context_ = egl_.createContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT) fail("making an OpenGL 4.5 core context");
        if (egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            fail("making the context current");
    }
    ~Session() { close(); }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

private:
    [[noreturn]] void fail(const char* step) {
        const EGLint error = egl_.error();
        close();
        throw Inconclusive(fmt::format("{} failed (EGL error 0x{:x})", step, error));
    }

    [[noreturn]] void lacks(const char* extension) {
        close();
        throw Inconclusive(fmt::format("it has no {}", extension));
    }

    void close() {
        if (context_ != EGL_NO_CONTEXT) {
            egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            egl_.destroyContext(display_, std::exchange(context_, EGL_NO_CONTEXT));
        }
        if (std::exchange(open_, false)) egl_.terminate(display_);
    }

    const Functions& egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool open_ = false;
};

/// On the first graphics processor that gives a context; nothing where there is none.
std::unique_ptr<Session> onGraphicsProcessor(const Functions& egl, bool debug) {
    const std::vector<EGLDeviceEXT> devices = graphicsProcessors(egl);
    for (void* device : devices) {
        try {
            return std::make_unique<Session>(egl, EGL_PLATFORM_DEVICE_EXT, device, debug);
        } catch (const Inconclusive&) { // another may do
        }
    }
    return nullptr;
}

std::unique_ptr<Session> inSoftware(const Functions& egl, const ContextOptions& options) {
    fixRasteriser(options);
    setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
    try {
        if (!hasExtension(egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
            throw Inconclusive("it has no EGL_MESA_platform_surfaceless");
        return std::make_unique<Session>(egl, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, options.debug);
    } catch (const Inconclusive& error) {
        throw Inconclusive(std::string("drawing through EGL failed: ") + error.what() +
                           "; install what it needs with: apt-get install libegl-mesa0 libgl1-mesa-dri");
    }
}

class EglContext final : public Context {
public:
    EglContext(const ContextOptions& options, bool software)
        : Context(Platform::Egl, options), egl_(functionsOf(eglLibrary())) {
        if (!software) session_ = onGraphicsProcessor(egl_, options.debug);
        if (!session_) session_ = inSoftware(egl_, options);
        becomeCurrent(options.debug, [this](const char* name) { return reinterpret_cast<void*>(egl_.find(name)); });
    }

    ~EglContext() override { ceaseCurrent(); }

private:
    Functions egl_;
    std::unique_ptr<Session> session_;
};

} // namespace

const Library& eglLibrary() {
    static const Library library("libEGL.so.1", "SHADOWBENCH_LIBEGL");
    return library;
}

std::unique_ptr<Context> makeEglContext(const ContextOptions& options, bool software) {
    return std::make_unique<EglContext>(options, software);
}

} // namespace shadowbench::gl
