#include "base/words.h"

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace {

/// Insertions, deletions, replacements and swaps of neighbours (optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            cost[i][j] = std::min({replaced, cost[i - 1][j] + 1, cost[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost.back().back();
}

} // namespace

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
    const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : known) {
        // Of a word that is far too long the distance would take long, too.
        if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) > limit) continue;
        if (const std::size_t distance = editDistance(word, candidate); distance <= limit)
            near.emplace_back(distance, candidate);
    }
    if (near.empty()) return "";
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string words = fmt::format("\"{}\"", near.front().second);
    for (std::size_t i = 1; i < std::min<std::size_t>(near.size(), 3); ++i)
        words += fmt::format(" or \"{}\"", near[i].second);
    return fmt::format(" (did you mean {}?)", words);
}

void throwUnknownWord(std::string_view kind, std::string_view word, const std::vector<std::string>& known) {
    throw BadInput(
        fmt::format("there is no {} \"{}\"{}; there are {}", kind, word, didYouMean(word, known), fmt::join(known, ", ")));
}

} // namespace shadowbench
