// The harness's own check of a row: a figure that no method can mean is marked wherever the row stands.
#pragma once

#include "harness/records/record.h"

#include <string>
#include <vector>

namespace shadowbench::report {

/// A row whose error is this many times that of an image without shadows, or more, is worse than none …
inline constexpr double worstTimesNone = 1;
/// … and one whose error changes by more than this factor with a map or an image a fortieth larger stands on single texels.
inline constexpr double worstStep = 2;

struct Doubt {
    std::string says;       // "worse than no shadow: 1.68 times its error"
    bool explained = false; // the scene's `[expect]` says why
};

/// What is doubtful in a record's error; empty for a sound one, and for one that was not scored.
std::vector<Doubt> doubts(const Record& record);

/// The unexplained ones in one text, joined by "; "; "" without any.
std::string unexplainedDoubts(const Record& record);

} // namespace shadowbench::report
