#include "harness/foreign/foreign_row.h"

#include "base/error.h"

#include <fmt/format.h>

namespace shadowbench::foreign {

std::string_view name(Means means) {
    switch (means) {
    case Means::Hard:
        return "hard";
    case Means::Area:
        return "area";
    case Means::Irradiance:
        return "irradiance";
    case Means::SolidAngle:
        return "solid-angle";
    }
    return "";
}

Means meansNamed(std::string_view word) {
    for (const Means means : allMeans)
        if (name(means) == word) return means;
    throw BadInput(fmt::format("images mean hard, area, irradiance or solid-angle, not \"{}\" (docs/score.md, \"What the "
                               "numbers mean\")",
                               word));
}

} // namespace shadowbench::foreign
