// Everything that knows OSMesa. Mesa 25.1 dropped it: an EGL context would be a second file behind the same header.
#include "base/error.h"
#include "techniques/gl/context.h"

#include <GL/osmesa.h>
#include <array>
#include <cstdlib>

namespace shadowbench::gl {
namespace {

/// Mesa reads these when the context is made; they fix the code that is generated, hence the image and the instruction
/// count.
void fixRasteriser(const ContextOptions& options) {
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", std::to_string(options.rasterThreads).c_str(), 1);
    setenv("LP_NATIVE_VECTOR_WIDTH", std::to_string(options.vectorBits).c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", options.shaderCache.empty() ? "true" : "false", 1);
    if (!options.shaderCache.empty()) setenv("MESA_SHADER_CACHE_DIR", options.shaderCache.c_str(), 1);
}

class OsMesaContext final : public Context {
public:
    explicit OsMesaContext(const ContextOptions& options) : Context(options.rasterThreads, options.vectorBits) {
        fixRasteriser(options);
        constexpr std::array<int, 13> attributes{OSMESA_FORMAT,
                                                 OSMESA_RGBA,
                                                 OSMESA_DEPTH_BITS,
                                                 0,
                                                 OSMESA_STENCIL_BITS,
                                                 0,
                                                 OSMESA_PROFILE,
                                                 OSMESA_CORE_PROFILE,
                                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                                 4,
                                                 OSMESA_CONTEXT_MINOR_VERSION,
                                                 5,
                                                 0};
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (context_ == nullptr)
            throw Inconclusive(
                "making an OpenGL 4.5 core context with OSMesa failed; install libosmesa6 of Debian 12 (Mesa 22.3)");
        if (OSMesaMakeCurrent(context_, pixel_.data(), 0x1401 /* GL_UNSIGNED_BYTE */, 1, 1) == 0) {
            OSMesaDestroyContext(context_);
            throw Inconclusive("making the OSMesa context current failed");
        }
        becomeCurrent(options.debug);
    }

    ~OsMesaContext() override {
        ceaseCurrent();
        OSMesaDestroyContext(context_);
    }

    [[nodiscard]] void* function(const char* name) const override {
        const OSMESAproc found = OSMesaGetProcAddress(name);
        if (found == nullptr) throw InternalError(std::string("OSMesa has no function ") + name);
        return reinterpret_cast<void*>(found);
    }

private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{}; // all drawing goes to framebuffer objects
};

} // namespace

std::unique_ptr<Context> Context::create(const ContextOptions& options) { return std::make_unique<OsMesaContext>(options); }

} // namespace shadowbench::gl
