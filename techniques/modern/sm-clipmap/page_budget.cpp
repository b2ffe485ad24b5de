#include "techniques/modern/sm-clipmap/page_budget.h"

#include <ranges>
#include <set>
#include <tuple>

namespace shadowbench::techniques {

Page coarserPage(const Page& page) {
    return {page.plane, page.level + 1, {page.at.x >> 1, page.at.y >> 1}}; // rounded down, of negative ones, too
}

std::vector<Page> pagesThatFit(AskedPages asked, int coarsest, std::size_t room) {
    using Place = std::tuple<bool, std::uint32_t, Page>; // of the coarsest level last, then by pixels
    const auto placeOf = [&](const Page& page) { return Place(page.level == coarsest, asked.at(page), page); };
    std::set<Place> leaving;
    for (const auto& [page, pixels] : asked) leaving.insert(placeOf(page));
    while (asked.size() > room) {
        const auto [last, pixels, page] = *leaving.begin();
        leaving.erase(leaving.begin());
        asked.erase(page);
        if (last) continue;
        const Page coarser = coarserPage(page);
        if (asked.contains(coarser)) leaving.erase(placeOf(coarser));
        asked[coarser] += pixels;
        leaving.insert(placeOf(coarser));
    }
    const auto pages = asked | std::views::keys;
    return {pages.begin(), pages.end()};
}

} // namespace shadowbench::techniques
