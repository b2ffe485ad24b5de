// The tools a request needs, and what is done once they are known: POV-Ray takes 0.2 s to tell its version.
#pragma once

#include "groundtruth/reference.h"

namespace shadowbench::groundtruth {

/// Tool or part of this code → version.
using Tools = std::map<std::string, std::string>;

/// Of all that decides the reference's numbers. Throws Inconclusive if POV-Ray is needed and missing.
Tools toolVersions(const Request& request);

/// As the functions of reference.h, with toolVersions(request) known.
std::string key(const Request& request, const Tools& tools);
Reference compute(const Request& request, const Tools& tools, const Progress& progress);

} // namespace shadowbench::groundtruth
