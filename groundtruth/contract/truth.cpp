// Truths and oracles by name, and which light has which.
#include "base/error.h"
#include "base/words.h"
#include "groundtruth/contract/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

constexpr Words<Truth, 6> truths{"truth",
                                 {{{Truth::Hard, "hard"},
                                   {Truth::Soft, "soft"},
                                   {Truth::PixelArea, "pixel-area"},
                                   {Truth::Area, "area"},
                                   {Truth::Irradiance, "irradiance"},
                                   {Truth::SolidAngle, "solid-angle"}}}};
constexpr Words<Oracle, 4> oracles{
    "oracle", {{{Oracle::Auto, "auto"}, {Oracle::Polygon, "polygon"}, {Oracle::Rays, "rays"}, {Oracle::Plan, "plan"}}}};

} // namespace

std::string_view name(Truth truth) { return truths.of(truth); }
Truth truthNamed(std::string_view name) { return truths.named(name); }

bool hasTruth(const Light& light, Truth truth) {
    switch (truth) {
    case Truth::Soft:
        return light.isArea() || light.isEnvironment();
    case Truth::Area:
        return light.isArea();
    case Truth::Irradiance:
    case Truth::SolidAngle:
        return light.isArea() && light.kind != LightKind::Line;
    case Truth::Hard:
    case Truth::PixelArea:
        return !light.isEnvironment();
    }
    return false;
}

void requireTruth(std::string_view whose, const Light& light, Truth truth) {
    if (hasTruth(light, truth)) return;
    std::vector<std::string_view> fitting;
    for (const auto& [other, word] : truths.words)
        if (hasTruth(light, other)) fitting.push_back(word);
    throw BadInput(fmt::format("{} has no {} truth: its light is of kind {}, which has {}", whose, name(truth),
                               name(light.kind), fmt::join(fitting, ", ")));
}

Truth usualTruth(const Light& light) { return hasTruth(light, Truth::Soft) ? Truth::Soft : Truth::Hard; }

std::string_view name(Oracle oracle) { return oracles.of(oracle); }
Oracle oracleNamed(std::string_view name) { return oracles.named(name); }

} // namespace shadowbench::groundtruth
