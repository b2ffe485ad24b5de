// Everything that knows OSMesa, which Mesa has had no more since 25.1: so its few declarations stand here.
#include "base/error.h"
#include "techniques/gl/make_context.h"

#include <array>

namespace shadowbench::gl {
namespace {

constexpr const char* package = "install it with: apt-get install libosmesa6";

// <GL/osmesa.h> and <GL/gl.h>
struct osmesa_context;
using Handle = osmesa_context*;
constexpr int rgba = 0x1908, format = 0x22, depthBits = 0x30, stencilBits = 0x31, profile = 0x33, coreProfile = 0x34,
              majorVersion = 0x36, minorVersion = 0x37;
constexpr unsigned unsignedByte = 0x1401;

struct Functions {
    Handle (*create)(const int* attributes, Handle shared);
    unsigned char (*makeCurrent)(Handle, void* buffer, unsigned type, int width, int height);
    void (*destroy)(Handle);
    void* (*find)(const char* name);
};

Functions functionsOf(const Library& library) {
    if (!library.whyNot().empty())
        throw Inconclusive("drawing with OSMesa failed: " + library.whyNot() + "; " + package +
                           ", or draw through EGL with --gl egl");
    return {library.function<decltype(Functions::create)>("OSMesaCreateContextAttribs"),
            library.function<decltype(Functions::makeCurrent)>("OSMesaMakeCurrent"),
            library.function<decltype(Functions::destroy)>("OSMesaDestroyContext"),
            library.function<decltype(Functions::find)>("OSMesaGetProcAddress")};
}

class OsMesaContext final : public Context {
public:
    explicit OsMesaContext(const ContextOptions& options)
        : Context(Platform::OsMesa, options), osMesa_(functionsOf(osMesaLibrary())) {
        fixRasteriser(options);
        constexpr std::array<int, 13> attributes{
            format, rgba, depthBits, 0, stencilBits, 0, profile, coreProfile, majorVersion, 4, minorVersion, 5, 0};
        context_ = {osMesa_.create(attributes.data(), nullptr), osMesa_.destroy};
        if (!context_)
            throw Inconclusive(
                "making an OpenGL 4.5 core context with OSMesa failed; install libosmesa6 of Debian 12 (Mesa 22.3)");
        if (osMesa_.makeCurrent(context_.get(), pixel_.data(), unsignedByte, 1, 1) == 0)
            throw Inconclusive("making the OSMesa context current failed");
        becomeCurrent(options.debug, osMesa_.find);
    }

    ~OsMesaContext() override { ceaseCurrent(); }

private:
    Functions osMesa_;
    std::unique_ptr<osmesa_context, void (*)(Handle)> context_{nullptr, osMesa_.destroy};
    std::array<unsigned char, 4> pixel_{}; // all drawing goes to framebuffer objects
};

} // namespace

const Library& osMesaLibrary() {
    static const Library library("libOSMesa.so.8", "SHADOWBENCH_LIBOSMESA");
    return library;
}

std::unique_ptr<Context> makeOsMesaContext(const ContextOptions& options) {
    return std::make_unique<OsMesaContext>(options);
}

} // namespace shadowbench::gl
