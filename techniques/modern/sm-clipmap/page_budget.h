// Which of the pages that pixels ask for find room (no GL).
#pragma once

#include "techniques/shared/maps/page.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace shadowbench::techniques {

/// How many pixels ask for each page.
using AskedPages = std::map<Page, std::uint32_t>;

/// At most `room` pages, in their order. As long as there are more, the page that the fewest pixels ask for (of those the
/// first) is left out, and these ask for the page of the next coarser level that it lies in; a page of the level `coarsest`
/// goes when no others are left.
std::vector<Page> pagesThatFit(AskedPages asked, int coarsest, std::size_t room);

/// The page of the next coarser level that a page lies in, twice as wide.
Page coarserPage(const Page& page);

} // namespace shadowbench::techniques
