// The page of a technique in docs/techniques: what its entry in the catalogue says, what it costs, and the scenes on which
// it is good and on which it breaks, with a picture of each.
#pragma once

#include "harness/records/record.h"
#include "techniques/contract/entry.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench {

/// Markdown. The scenes are those of `records` on which the default variant has the least and the greatest ratio of its
/// error to that of `none` on the same scene, for levels of detail to that of `lod-switch`. The error is the table's main
/// one for the kind of answer: mismatching pixels of hard and filtered shadows (so that area lights do not count), the rms
/// error of soft ones, the pop of levels of detail. Shows those of <id>-good.png and <id>-breaks.png that the folder
/// `pictures` holds.
std::string techniquePage(const techniques::Entry& entry, const std::vector<Record>& records,
                          const std::filesystem::path& pictures);

/// Writes the page of each technique of the catalogue as <id>.md into the folder; pictures are those of the folder
/// ../pictures/techniques beside it.
void writeTechniquePages(const std::vector<Record>& records, const std::filesystem::path& folder);

} // namespace shadowbench
