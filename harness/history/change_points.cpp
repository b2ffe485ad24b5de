#include "harness/history/change_points.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shadowbench::history {
namespace {

double pairs(std::size_t n) { return 0.5 * static_cast<double>(n) * static_cast<double>(n - 1); }

/// Sums of distances between figures before, after and across a split that moves to the right one figure at a time.
class MovingSplit {
public:
    explicit MovingSplit(const std::vector<double>& values) : values_(values) {
        for (std::size_t i = 0; i < values.size(); ++i) after_ += distances(i, i + 1, values.size());
    }

    void advance() {
        const double toBefore = distances(split_, 0, split_), toAfter = distances(split_, split_ + 1, values_.size());
        before_ += toBefore;
        across_ += toAfter - toBefore;
        after_ -= toAfter;
        ++split_;
    }

    [[nodiscard]] std::size_t split() const { return split_; }

    [[nodiscard]] double statistic() const {
        const std::size_t m = split_, n = values_.size() - split_;
        const double product = static_cast<double>(m) * static_cast<double>(n);
        const double energy = 2 * across_ / product - before_ / pairs(m) - after_ / pairs(n);
        return product / static_cast<double>(m + n) * energy;
    }

private:
    [[nodiscard]] double distances(std::size_t from, std::size_t first, std::size_t end) const {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) sum += std::abs(values_[from] - values_[i]);
        return sum;
    }

    const std::vector<double>& values_;
    std::size_t split_ = 0;
    double before_ = 0, after_ = 0, across_ = 0;
};

struct Best {
    std::size_t split = 0; // 0: there is no place for one
    double statistic = 0;
};

/// The split with the largest statistic among those that leave `shortest` figures on either side and split no group.
Best bestSplit(const std::vector<double>& values, const std::vector<std::size_t>& groups, std::size_t shortest) {
    Best best;
    if (values.size() < 2 * shortest) return best;
    MovingSplit moving(values);
    while (moving.split() + shortest < values.size()) {
        moving.advance();
        const std::size_t split = moving.split();
        if (split < shortest || groups[split] == groups[split - 1]) continue;
        const double statistic = moving.statistic();
        if (best.split == 0 || statistic > best.statistic) best = {split, statistic};
    }
    return best;
}

/// Fisher and Yates.
void shuffle(std::vector<double>& values, Random& random) {
    for (std::size_t i = values.size(); i > 1; --i)
        std::swap(values[i - 1], values[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
}

/// Whether (1 + permutations with as large a statistic) / (1 + permutations) ≤ alpha; permutations end once it cannot be.
bool isRare(double statistic, std::vector<double> values, const std::vector<std::size_t>& groups, const NoiseRule& rule,
            Random& random) {
    constexpr double resolution = 10; // alpha is so many times the smallest probability that can be found
    const auto permutations = static_cast<int>(std::ceil(resolution / rule.alpha)) - 1;
    const double most = rule.alpha * (permutations + 1) - 1;
    const double rounding = 1e-9 * std::abs(statistic); // another order of the same sums
    int asLarge = 0;
    for (int i = 0; i < permutations && asLarge <= most; ++i) {
        shuffle(values, random);
        if (bestSplit(values, groups, rule.shortest).statistic >= statistic - rounding) ++asLarge;
    }
    return asLarge <= most;
}

void search(const std::vector<double>& values, const std::vector<std::size_t>& groups, std::size_t first, std::size_t end,
            const NoiseRule& rule, Random& random, std::vector<std::size_t>& changes) {
    const auto part = [&](const auto& whole) {
        return std::vector(whole.begin() + static_cast<std::ptrdiff_t>(first),
                           whole.begin() + static_cast<std::ptrdiff_t>(end));
    };
    const std::vector<double> figures = part(values);
    const std::vector<std::size_t> owners = part(groups);
    const Best best = bestSplit(figures, owners, rule.shortest);
    if (best.split == 0 || best.statistic <= 0 || !isRare(best.statistic, figures, owners, rule, random)) return;
    const std::size_t split = first + best.split;
    search(values, groups, first, split, rule, random, changes);
    changes.push_back(split);
    search(values, groups, split, end, rule, random, changes);
}

} // namespace

std::vector<std::size_t> levelChanges(const std::vector<double>& values, const std::vector<double>& allowances) {
    std::vector<std::size_t> changes;
    std::size_t level = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (std::abs(values[i] - values[level]) <= allowances[level]) continue;
        changes.push_back(i);
        level = i;
    }
    return changes;
}

double energyStatistic(const std::vector<double>& values, std::size_t split) {
    MovingSplit moving(values);
    while (moving.split() < split) moving.advance();
    return moving.statistic();
}

std::vector<std::size_t> distributionChanges(const std::vector<double>& values, const std::vector<std::size_t>& groups,
                                             const NoiseRule& rule) {
    std::vector<std::size_t> changes;
    Random random(rule.seed);
    search(values, groups, 0, values.size(), rule, random, changes);
    return changes;
}

} // namespace shadowbench::history
