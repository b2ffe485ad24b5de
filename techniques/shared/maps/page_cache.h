// Which pages of shadow maps that are drawn in pages are kept from frame to frame, and where (no GL).
#pragma once

#include "techniques/shared/maps/page.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// A page and the slot for its map.
struct HeldPage {
    std::size_t number; // of the page, in the order in which it was asked for
    int slot;
    bool kept; // its map is in the slot already
};

/// Pages whose maps are there together.
using Filling = std::vector<HeldPage>;

class PageCache {
public:
    explicit PageCache(int slots) : slots_(static_cast<std::size_t>(slots)) {}

    /// Slots for a frame's pages, of which no two are equal, in as few fillings as there must be: the maps of one filling
    /// are used before those of the next are drawn over them. The first filling holds all pages that were kept. Others are
    /// given empty slots, and then those whose pages have not been asked for the longest.
    std::vector<Filling> place(std::span<const Page> pages);

    /// Forgets the pages for which `isStale` is true.
    void drop(const std::function<bool(const Page&)>& isStale);

    void clear();

private:
    struct Slot {
        std::optional<Page> page;
        std::uint64_t asked = 0; // when, in calls of `place`; 0: never
    };
    [[nodiscard]] std::vector<int> slotsToFill() const;
    void put(const Page& page, int slot);

    std::uint64_t now_ = 0;
    std::vector<Slot> slots_;
    std::map<Page, int> slotOf_;
};

} // namespace shadowbench::techniques
