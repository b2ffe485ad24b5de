#include "techniques/gl/platform.h"

#include "base/error.h"
#include "base/words.h"
#include "techniques/gl/make_context.h"

#include <cstdlib>

namespace shadowbench::gl {
namespace {

constexpr const char* choice = "SHADOWBENCH_GL";
constexpr Words<Platform, 3> platforms{"OpenGL",
                                       {{{Platform::Auto, "auto"}, {Platform::OsMesa, "osmesa"}, {Platform::Egl, "egl"}}}};

} // namespace

std::string_view name(Platform platform) { return platforms.of(platform); }

Platform platformNamed(std::string_view word) { return platforms.named(word); }

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
