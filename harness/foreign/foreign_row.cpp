#include "harness/foreign/foreign_row.h"

#include "base/words.h"

namespace shadowbench::foreign {
namespace {

constexpr Words<Definition, 4> definitions{"definition of visibility (docs/score.md, \"What the numbers mean\")",
                                           {{{Definition::Hard, "hard"},
                                             {Definition::Area, "area"},
                                             {Definition::Irradiance, "irradiance"},
                                             {Definition::SolidAngle, "solid-angle"}}}};

} // namespace

std::string_view name(Definition definition) { return definitions.of(definition); }
Definition definitionNamed(std::string_view word) { return definitions.named(word); }

} // namespace shadowbench::foreign
