// Percentage-closer filtering as a part of other techniques.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"

#include <memory>
#include <vector>

namespace shadowbench::techniques {

/// `kernel`, `depth`, `map`, `bias` (with `normal-offset`), `factor` and `units`.
std::vector<Parameter> pcfParameters();

/// `pcf` with these parameters.
std::unique_ptr<Technique> makePcf(const Parameters& parameters);

} // namespace shadowbench::techniques
