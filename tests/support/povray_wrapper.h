// POV-Ray with a fault: scripts that change the scene's lights and then run the real program.
#pragma once

#include "base/files.h"
#include "groundtruth/povray/povray.h"
#include "scene/camera.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <string>

namespace shadowbench::groundtruth {

enum class Wrapper { Honest, ShiftedByHalfAPercent, ShiftedByOneAndAHalf, ShiftedByFour, EveryFiftiethDropped, PlainGrid };
inline constexpr std::array faultyWrappers{Wrapper::ShiftedByHalfAPercent, Wrapper::ShiftedByOneAndAHalf,
                                           Wrapper::ShiftedByFour, Wrapper::EveryFiftiethDropped, Wrapper::PlainGrid};

inline const char* name(Wrapper wrapper) {
    constexpr std::array names{"honest",           "light off by 0.5 %", "light off by 1.5 %",
                               "light off by 4 %", "every 50th dropped", "plain grid"};
    return names[static_cast<std::size_t>(wrapper)];
}

/// What the script does to the line of the sample `n` (from 0), whose position is x, y, z, in awk.
inline std::string changeOfSample(Wrapper wrapper, const Light& light, int samples, double scale) {
    const auto moved = [](const glm::dvec3& by) {
        return fmt::format("x += {:.17g}; y += {:.17g}; z += {:.17g};", by.x, by.y, by.z);
    };
    const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(samples))));
    const glm::dvec3 centre = scale * light.centre, u = scale * light.u, v = scale * light.v;
    switch (wrapper) {
    case Wrapper::ShiftedByHalfAPercent:
        return moved(0.005 * u);
    case Wrapper::ShiftedByOneAndAHalf:
        return moved(0.015 * u);
    case Wrapper::ShiftedByFour:
        return moved(0.04 * u);
    case Wrapper::EveryFiftiethDropped:
        return "if (n % 50 == 49) { ++n; next }";
    case Wrapper::PlainGrid:
        return fmt::format("a = (n % {0} + 0.5) / {0} - 0.5; b = (int(n / {0}) + 0.5) / {0} - 0.5; "
                           "x = {1:.17g} + a * {2:.17g} + b * {3:.17g}; y = {4:.17g} + a * {5:.17g} + b * {6:.17g}; "
                           "z = {7:.17g} + a * {8:.17g} + b * {9:.17g};",
                           side, centre.x, u.x, v.x, centre.y, u.y, v.y, centre.z, u.z, v.z);
    case Wrapper::Honest:
        break;
    }
    return "";
}

/// A script that changes scene.pov by `awk`, its program and what it reads first.
inline std::filesystem::path writePovray(const std::filesystem::path& folder, const std::string& awk) {
    std::filesystem::path file = folder / "povray";
    writeFile(file, "#!/bin/sh\nif [ -f scene.pov ]; then\n  awk " + awk +
                        " scene.pov > changed.pov && mv changed.pov scene.pov\nfi\nexec /usr/bin/povray \"$@\"\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
}

/// POV-Ray without a fault, with the samples of another set of povray::lightSample.
inline std::filesystem::path writeWrapperOfSet(const std::filesystem::path& folder, const Light& light, int samples,
                                               double scale, std::uint32_t set) {
    std::string positions;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec3 p = scale * light.sample(povray::lightSample(i, samples, set));
        positions += fmt::format("{:.17g}, {:.17g}, {:.17g}\n", p.x, p.y, p.z);
    }
    const std::filesystem::path list = folder / "samples";
    writeFile(list, positions);
    return writePovray(folder, "'NR == FNR { at[FNR - 1] = $0; next } /^light_source/ { rest = $0; sub(/^[^>]*>/, \"\", "
                               "rest); print \"light_source { <\" at[n++] \">\" rest; next } { print }' " +
                                   list.string());
}

/// Writes the script `povray` into `folder`; give the folder to PATH or the file to povray::Options.
inline std::filesystem::path writeWrapper(const std::filesystem::path& folder, Wrapper wrapper, const Light& light,
                                          int samples, double scale) {
    return writePovray(folder, "'/^light_source/ { split($0, part, /[<,>]/); x = part[2]; y = part[3]; z = part[4]; " +
                                   changeOfSample(wrapper, light, samples, scale) +
                                   " rest = $0; sub(/^[^>]*>/, \"\", rest);"
                                   " printf \"light_source { <%.17g,%.17g,%.17g>%s\\n\", x, y, z, rest; ++n; next } "
                                   "{ print }'");
}

} // namespace shadowbench::groundtruth
