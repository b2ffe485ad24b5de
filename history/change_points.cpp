#include "history/change_points.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace shadowbench::history {
namespace {

/// Sums of the distances between all figures of every stretch.
class Distances {
public:
    explicit Distances(const std::vector<double>& values) : size_(values.size()), sums_((size_ + 1) * (size_ + 1)) {
        for (std::size_t end = 2; end <= size_; ++end) {
            double toLast = 0;
            for (std::size_t first = end - 1; first-- > 0;) {
                toLast += std::abs(values[first] - values[end - 1]);
                sums_[first * (size_ + 1) + end] = sums_[first * (size_ + 1) + end - 1] + toLast;
            }
        }
    }

    /// F of the stretches that begin at 0, `second` and, unless it is the end, `third`.
    [[nodiscard]] double ratio(std::size_t second, std::size_t third) const {
        const double all = within(0, size_);
        if (all <= 0) return 0;
        const double inside = within(0, second) + within(second, third) + within(third, size_);
        const double stretches = third == size_ ? 2 : 3;
        return (all - inside) / (stretches - 1) / (inside / (static_cast<double>(size_) - stretches));
    }

private:
    [[nodiscard]] double within(std::size_t first, std::size_t end) const {
        return first == end ? 0 : sums_[first * (size_ + 1) + end] / static_cast<double>(end - first);
    }

    std::size_t size_;
    std::vector<double> sums_;
};

struct Split {
    std::size_t second = 0, third = 0; // where stretches begin; the third may be the end
    double ratio = 0;                  // 0: there is no place for one
};

/// The split with the largest ratio among those that leave `shortest` figures in every stretch and divide no commit.
Split bestSplit(const Noisy& series, std::size_t shortest) {
    const std::size_t size = series.values.size();
    std::vector<std::size_t> places;
    for (std::size_t i = shortest; i + shortest <= size; ++i)
        if (series.commits[i] != series.commits[i - 1]) places.push_back(i);
    if (places.empty()) return {};
    places.push_back(size);
    const Distances distances(series.values);
    Split best;
    for (std::size_t a = 0; a + 1 < places.size(); ++a)
        for (std::size_t b = a + 1; b < places.size(); ++b) {
            if (places[b] - places[a] < shortest) continue;
            const double ratio = distances.ratio(places[a], places[b]);
            if (ratio > best.ratio) best = {places[a], places[b], ratio};
        }
    return best;
}

/// Fisher and Yates.
void shuffle(std::vector<double>& values, Random& random) {
    for (std::size_t i = values.size(); i > 1; --i)
        std::swap(values[i - 1], values[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
}

/// A stretch of one of the series that is judged by itself.
struct Part {
    std::size_t series, first, end;
};

Noisy figuresOf(const Noisy& series, std::size_t first, std::size_t end) {
    const auto part = [&](const auto& whole) {
        return std::vector(whole.begin() + static_cast<std::ptrdiff_t>(first),
                           whole.begin() + static_cast<std::ptrdiff_t>(end));
    };
    return {part(series.values), part(series.commits)};
}

/// Orders of all series that may reach a ratio for each series that does: each is one of its own orders, too.
double mostByChance(const NoiseRule& rule) { return rule.falseDiscoveries * (rule.orders + 1) - 1; }

/// The smallest of the ratios `found` that is a discovery, if any is. Both are in falling order.
std::optional<double> leastFound(const std::vector<double>& found, const std::vector<double>& byChance,
                                 const NoiseRule& rule) {
    constexpr double rounding = 1 - 1e-9; // another order of the same sums
    for (std::size_t k = found.size(); k > 0; --k) {
        const auto reach = std::ranges::upper_bound(byChance, rounding * found[k - 1], std::greater{});
        if (static_cast<double>(reach - byChance.begin()) <= static_cast<double>(k) * mostByChance(rule))
            return found[k - 1];
    }
    return {};
}

} // namespace

std::vector<std::size_t> levelChanges(const std::vector<double>& values, const std::vector<double>& allowances) {
    std::vector<std::size_t> changes;
    std::size_t level = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const auto isNear = [&](std::size_t before) { return std::abs(values[i] - values[before]) <= allowances[before]; };
        if (isNear(level) && isNear(i - 1)) continue;
        changes.push_back(i);
        level = i;
    }
    return changes;
}

double energyRatio(const std::vector<double>& values, const std::vector<std::size_t>& starts) {
    return Distances(values).ratio(starts.front(), starts.size() > 1 ? starts[1] : values.size());
}

NoiseChanges distributionChanges(const std::vector<Noisy>& series, const NoiseRule& rule) {
    NoiseChanges result{std::vector<std::vector<std::size_t>>(series.size())};
    std::vector<Part> parts;
    for (std::size_t i = 0; i < series.size(); ++i) parts.push_back({i, 0, series[i].values.size()});
    for (bool whole = true; !parts.empty(); whole = false) {
        std::vector<Split> splits;
        std::vector<double> found, byChance;
        for (const Part& part : parts) {
            Noisy figures = figuresOf(series[part.series], part.first, part.end);
            splits.push_back(bestSplit(figures, rule.shortest));
            if (splits.back().ratio <= 0) continue;
            found.push_back(splits.back().ratio);
            Random random(mixBits(rule.seed + part.series) + part.first);
            for (int i = 0; i < rule.orders; ++i) {
                shuffle(figures.values, random);
                byChance.push_back(bestSplit(figures, rule.shortest).ratio);
            }
        }
        std::ranges::sort(found, std::greater{});
        std::ranges::sort(byChance, std::greater{});
        const std::optional<double> least = leastFound(found, byChance, rule);
        const auto most = static_cast<std::size_t>(mostByChance(rule));
        if (whole && byChance.size() > most) result.leastRatio = byChance[most];
        std::vector<Part> next;
        for (std::size_t i = 0; least && i < parts.size(); ++i) {
            const auto& [of, first, end] = parts[i];
            const Split& split = splits[i];
            if (split.ratio < *least) continue;
            next.push_back({of, first, first + split.second});
            next.push_back({of, first + split.second, first + split.third});
            result.changes[of].push_back(first + split.second);
            if (first + split.third == end) continue;
            next.push_back({of, first + split.third, end});
            result.changes[of].push_back(first + split.third);
        }
        parts = std::move(next);
    }
    for (std::vector<std::size_t>& changes : result.changes) std::ranges::sort(changes);
    return result;
}

std::optional<double> smallestRise(const Noisy& series, double from, double leastRatio, const NoiseRule& rule) {
    constexpr double step = 1.02, most = 3; // of times: twenty times as long
    std::size_t newest = series.values.size() - std::min(rule.shortest, series.values.size());
    while (newest > 0 && series.commits[newest] == series.commits[newest - 1]) --newest;
    constexpr std::size_t fewest = 8; // of seven figures, 2 in 35 of their own orders have the newest three at one end
    if (newest < rule.shortest || series.values.size() < fewest) return {};
    for (double rise = from; rise < most; rise *= step) {
        std::vector<double> values = series.values;
        for (std::size_t i = newest; i < values.size(); ++i) values[i] += rise;
        if (bestSplit({values, series.commits}, rule.shortest).ratio > leastRatio) return rise;
    }
    return {};
}

} // namespace shadowbench::history
