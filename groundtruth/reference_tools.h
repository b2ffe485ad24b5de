// The tools a request needs, for its key and its provenance.
#pragma once

#include "groundtruth/reference.h"

namespace shadowbench::groundtruth {

/// Tool or part of this code → version, of all that decides the reference's numbers. Throws Inconclusive if POV-Ray is
/// needed and missing.
std::map<std::string, std::string> toolVersions(const Request& request);

} // namespace shadowbench::groundtruth
