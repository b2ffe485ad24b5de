// What to ship: the answer of all scenes in a few lines.
#pragma once

#include "harness/records/record.h"
#include "site/table.h"

#include <filesystem>
#include <vector>

namespace shadowbench::site {

/// Of scenes under lights without and with an area, and of a few costs as multiples of sm-uniform: the row that costs at
/// most so much on average (Multiples) and is within tolerance on most of these scenes; of several the cheapest. A cost that
/// buys the row of the one below has no line. Rows that may be taken at all (suitedOn), on scenes that a shadow map has an
/// answer for. No lines where no row has a cost.
Table shipTable(const std::vector<Record>& records, const std::filesystem::path& images);

} // namespace shadowbench::site
