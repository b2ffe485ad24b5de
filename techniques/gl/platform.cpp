#include "techniques/gl/platform.h"

#include "base/error.h"
#include "techniques/gl/make_context.h"

#include <array>
#include <cstdlib>

namespace shadowbench::gl {
namespace {

constexpr const char* choice = "SHADOWBENCH_GL";
constexpr std::array platforms{Platform::Auto, Platform::OsMesa, Platform::Egl};

} // namespace

std::string_view name(Platform platform) {
    switch (platform) {
    case Platform::OsMesa:
        return "osmesa";
    case Platform::Egl:
        return "egl";
    default:
        return "auto";
    }
}

Platform platformNamed(std::string_view word) {
    for (const Platform platform : platforms)
        if (name(platform) == word) return platform;
    throw BadInput("there is no OpenGL \"" + std::string(word) + "\"; choose auto, osmesa or egl");
}

Platform chosenPlatform() {
    const char* word = std::getenv(choice);
    if (word == nullptr || *word == '\0') return Platform::Auto;
    try {
        return platformNamed(word);
    } catch (const BadInput& error) {
        throw BadInput(std::string("the environment variable ") + choice + " is wrong: " + error.what());
    }
}

bool drawsWithOsMesa() { return chosenPlatform() != Platform::Egl && osMesaLibrary().whyNot().empty(); }

void choosePlatform(Platform platform) { setenv(choice, std::string(name(platform)).c_str(), 1); }

std::vector<std::string> platformVariables() {
    return {choice,
            "SHADOWBENCH_LIBOSMESA",
            "SHADOWBENCH_LIBEGL",
            "LIBGL_ALWAYS_SOFTWARE",
            "LD_LIBRARY_PATH",
            "__EGL_VENDOR_LIBRARY_DIRS",
            "__EGL_VENDOR_LIBRARY_FILENAMES"};
}

} // namespace shadowbench::gl
