#include "techniques/contract/need.h"

#include "base/error.h"
#include "base/files.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr std::array<std::pair<Need, std::string_view>, 6> names{{{Need::AnyReceiver, "any-receiver"},
                                                                  {Need::AnyEye, "any-eye"},
                                                                  {Need::MovingLight, "moving-light"},
                                                                  {Need::MovingCasters, "moving-casters"},
                                                                  {Need::OpenMeshes, "open-meshes"},
                                                                  {Need::NoHistory, "no-history"}}};

} // namespace

std::string_view name(Need need) {
    return std::ranges::find(names, need, &std::pair<Need, std::string_view>::first)->second;
}

std::string namesOf(const std::set<Need>& needs) {
    std::vector<std::string_view> all;
    for (const Need need : needs) all.push_back(name(need));
    return fmt::format("{}", fmt::join(all, ", "));
}

Need needNamed(const std::string& word) {
    std::vector<std::string> known;
    for (const auto& [need, named] : names) {
        if (named == word) return need;
        known.emplace_back(named);
    }
    throw BadInput(
        fmt::format("there is no need \"{}\"{}; the needs are {}", word, didYouMean(word, known), fmt::join(known, ", ")));
}

const std::set<Need>& usualNeeds() {
    static const std::set<Need> usual{Need::AnyReceiver, Need::AnyEye, Need::MovingLight, Need::MovingCasters,
                                      Need::OpenMeshes};
    return usual;
}

} // namespace shadowbench::techniques
