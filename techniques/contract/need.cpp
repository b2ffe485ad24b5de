#include "techniques/contract/need.h"

#include "base/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr Words<Need, 6> needs{"need",
                               {{{Need::AnyReceiver, "any-receiver"},
                                 {Need::AnyEye, "any-eye"},
                                 {Need::MovingLight, "moving-light"},
                                 {Need::MovingCasters, "moving-casters"},
                                 {Need::OpenMeshes, "open-meshes"},
                                 {Need::NoHistory, "no-history"}}}};

} // namespace

std::string_view name(Need need) { return needs.of(need); }

std::string namesOf(const std::set<Need>& some) {
    std::vector<std::string_view> all;
    for (const Need need : some) all.push_back(name(need));
    return fmt::format("{}", fmt::join(all, ", "));
}

Need needNamed(std::string_view word) { return needs.named(word); }

const std::set<Need>& usualNeeds() {
    static const std::set<Need> usual{Need::AnyReceiver, Need::AnyEye, Need::MovingLight, Need::MovingCasters,
                                      Need::OpenMeshes};
    return usual;
}

} // namespace shadowbench::techniques
