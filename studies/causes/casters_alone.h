// A frame's casters one by one: what each alone casts says what their combination may.
#pragma once

#include "scene/snapshot.h"

#include <vector>

namespace shadowbench::causes {

/// Of a frame's batches those with one group of casters each, the first with none: the placements whose id is at most
/// `ground` stand in all of them. Every placement beyond is in one group, neighbours by id in different ones; there are at
/// most `most` groups, none with fewer than two casters. Where a group is not, a speck in each corner of its placements'
/// bounds keeps what is fitted to the scene as it is.
std::vector<std::vector<Batch>> castersAlone(const std::vector<Batch>& all, std::uint32_t ground, std::uint32_t most);

} // namespace shadowbench::causes
