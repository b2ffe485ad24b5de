// What a check found, in words.
#pragma once

#include "studies/claims/claims.h"

#include <string>

namespace shadowbench {

/// "accuracy.mismatch of a on s = 0.0147 ± 0.0006 ≤ 0.5 × accuracy.mismatch of b on s = 0.0169: yes"; in several
/// cases what they have in common comes first: "accuracy.mismatch of a ≤ 0.5 × of b: on s = 0.0147 ≤ 0.5 × 0.0169; on t …".
std::string describe(const Check& check, const Finding& finding);

/// What the check says, with our figures, over all cases: "at most a tenth: 0.13 to 0.42 (no)".
std::string inShort(const Check& check, const Finding& finding);

} // namespace shadowbench
