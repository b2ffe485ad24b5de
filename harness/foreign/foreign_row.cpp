#include "harness/foreign/foreign_row.h"

#include "base/error.h"

#include <fmt/format.h>

namespace shadowbench::foreign {

std::string_view name(Definition definition) {
    switch (definition) {
    case Definition::Hard:
        return "hard";
    case Definition::Area:
        return "area";
    case Definition::Irradiance:
        return "irradiance";
    case Definition::SolidAngle:
        return "solid-angle";
    }
    return "";
}

Definition definitionNamed(std::string_view word) {
    for (const Definition definition : allDefinitions)
        if (name(definition) == word) return definition;
    throw BadInput(fmt::format("images mean hard, area, irradiance or solid-angle, not \"{}\" (docs/score.md, \"What the "
                               "numbers mean\")",
                               word));
}

} // namespace shadowbench::foreign
