// The oracles' names on the command line.
#include "groundtruth/contract/reference.h"

#include "base/error.h"
#include "base/files.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

constexpr std::array<std::pair<Oracle, std::string_view>, 8> oracles{{{Oracle::Auto, "auto"},
                                                                      {Oracle::Polygon, "polygon"},
                                                                      {Oracle::Rays, "rays"},
                                                                      {Oracle::Plan, "plan"},
                                                                      {Oracle::Area, "area"},
                                                                      {Oracle::PovRay, "povray"},
                                                                      {Oracle::Irradiance, "irradiance"},
                                                                      {Oracle::SolidAngle, "solid-angle"}}};

} // namespace

std::string_view name(Oracle oracle) {
    for (const auto& [value, text] : oracles)
        if (value == oracle) return text;
    return "";
}

Oracle oracleNamed(std::string_view name) {
    std::vector<std::string> known;
    for (const auto& [value, text] : oracles) {
        if (text == name) return value;
        known.emplace_back(text);
    }
    throw BadInput(
        fmt::format("unknown oracle \"{}\"{}; valid are {}", name, didYouMean(name, known), fmt::join(known, ", ")));
}

} // namespace shadowbench::groundtruth
