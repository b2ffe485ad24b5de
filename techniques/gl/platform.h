// What gives a process its OpenGL: OSMesa, or EGL without a window.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gl {

/// Auto: Mesa's rasteriser in software, so that results can be reproduced on any machine; through OSMesa where it is
/// installed, else through EGL. Egl: the first graphics processor that EGL has, else the same rasteriser in software.
enum class Platform { Auto, OsMesa, Egl };

/// "auto", "osmesa", "egl".
std::string_view name(Platform platform);

/// Throws BadInput naming what there is.
Platform platformNamed(std::string_view name);

/// What the environment variable SHADOWBENCH_GL says; Auto where it says nothing. Throws BadInput for another word.
Platform chosenPlatform();

/// Whether contexts come from OSMesa: EGL is not chosen, and OSMesa is installed. Throws as chosenPlatform does.
bool drawsWithOsMesa();

/// Makes `platform` what is chosen, in this process and in those that it starts.
void choosePlatform(Platform platform);

/// The environment variables that decide what draws: whoever starts this program in an environment of its own passes these
/// on.
std::vector<std::string> platformVariables();

} // namespace shadowbench::gl
