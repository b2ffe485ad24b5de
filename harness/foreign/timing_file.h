// What a renderer says of its own costs: timing.json beside its images (docs/external.md, "Costs that it reports").
#pragma once

#include "harness/records/record.h"

#include <filesystem>
#include <optional>

namespace shadowbench::foreign {

/// Nothing if there is no such file. Throws Inconclusive naming file and key when it is not of the documented form.
std::optional<ReportedCost> reportedCost(const std::filesystem::path& file);

} // namespace shadowbench::foreign
