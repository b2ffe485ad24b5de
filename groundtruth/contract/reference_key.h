// The key of a reference in the cache: a hash of everything that its numbers depend on.
#pragma once

#include "groundtruth/contract/reference.h"

namespace shadowbench::groundtruth {

/// Tool or part of this code → version.
using Tools = std::map<std::string, std::string>;

/// Content hash (32 hex digits, XXH3-128) of all that the reference depends on: camera, light, mesh bytes, placements and
/// their ids, size, oracle, samples (area lights and environments only), oracle code and tool versions. Colours, previous
/// matrices, the frame number and the order of batches do not count.
std::string key(const Request& request, const Tools& tools);

} // namespace shadowbench::groundtruth
