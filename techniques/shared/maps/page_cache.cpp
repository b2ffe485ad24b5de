#include "techniques/shared/maps/page_cache.h"

#include <algorithm>
#include <numeric>

namespace shadowbench::techniques {

std::vector<int> PageCache::slotsToFill() const {
    std::vector<int> order;
    for (int slot = 0; slot < static_cast<int>(slots_.size()); ++slot)
        if (slots_[static_cast<std::size_t>(slot)].asked != now_) order.push_back(slot);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return slots_[static_cast<std::size_t>(a)].asked < slots_[static_cast<std::size_t>(b)].asked;
    });
    return order;
}

void PageCache::put(const Page& page, int slot) {
    Slot& held = slots_[static_cast<std::size_t>(slot)];
    if (held.page) slotOf_.erase(*held.page);
    held = {page, now_};
    slotOf_[page] = slot;
}

std::vector<Filling> PageCache::place(std::span<const Page> pages) {
    if (pages.empty()) return {};
    ++now_;
    std::vector<Filling> fillings(1);
    std::vector<std::size_t> missing;
    for (std::size_t number = 0; number < pages.size(); ++number) {
        const auto found = slotOf_.find(pages[number]);
        if (found == slotOf_.end()) {
            missing.push_back(number);
            continue;
        }
        slots_[static_cast<std::size_t>(found->second)].asked = now_;
        fillings.front().push_back({number, found->second, true});
    }

    std::vector<int> free = slotsToFill();
    for (std::size_t placed = 0; placed < missing.size();) {
        if (free.empty()) { // a further filling, which takes no more slots than it needs: what is in the others is kept
            const std::size_t count = std::min(missing.size() - placed, slots_.size());
            free.resize(count);
            std::iota(free.begin(), free.end(), static_cast<int>(slots_.size() - count));
            fillings.emplace_back();
        }
        const std::size_t count = std::min(missing.size() - placed, free.size());
        for (std::size_t i = 0; i < count; ++i, ++placed) {
            put(pages[missing[placed]], free[i]);
            fillings.back().push_back({missing[placed], free[i], false});
        }
        free.clear();
    }
    return fillings;
}

void PageCache::drop(const std::function<bool(const Page&)>& isStale) {
    for (Slot& slot : slots_) {
        if (!slot.page || !isStale(*slot.page)) continue;
        slotOf_.erase(*slot.page);
        slot = {};
    }
}

void PageCache::clear() {
    drop([](const Page&) { return true; });
}

} // namespace shadowbench::techniques
