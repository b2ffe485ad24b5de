#include "studies/causes/cause.h"

#include <array>

namespace shadowbench::causes {
namespace {

const std::array causeTable{
    CauseWords{Cause::Geometry, "geometry too coarse", "brown", {0.5F, 0.25F, 0.05F}},
    CauseWords{Cause::Outside, "outside of the map", "white", {1, 1, 1}},
    CauseWords{Cause::Leak, "leak behind another caster", "yellow", {1, 0.9F, 0}},
    CauseWords{Cause::Fusion, "occluder fusion", "orange", {1, 0.5F, 0}},
    CauseWords{Cause::History, "history", "violet", {0.4F, 0.2F, 0.8F}},
    CauseWords{Cause::Filter, "filter too wide", "green", {0, 0.65F, 0.1F}},
    CauseWords{Cause::SmallBias, "bias too small", "red", {0.9F, 0.1F, 0.1F}},
    CauseWords{Cause::Undersampled, "undersampled", "cyan", {0, 0.8F, 0.9F}},
    CauseWords{Cause::LargeBias, "bias too large", "blue", {0.1F, 0.3F, 1}},
    CauseWords{Cause::FewSamples, "too few samples", "pink", {1, 0.5F, 0.75F}},
    CauseWords{Cause::Method, "the method", "magenta", {1, 0, 0.7F}},
};

} // namespace

std::span<const CauseWords> allCauses() { return causeTable; }

const CauseWords& words(Cause cause) { return causeTable.at(static_cast<std::size_t>(cause)); }

} // namespace shadowbench::causes
