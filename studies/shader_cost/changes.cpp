// Before and after, as Mesa's shader-db reports them.
#include "studies/shader_cost/shader_cost.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <tuple>

namespace shadowbench::shaders {
namespace {

using ByName = std::map<std::pair<std::string, std::string>, const ShaderCost*>; // architecture, then shader

ByName byName(const ShaderCosts& costs) {
    ByName all;
    for (const ShaderCost& shader : costs.shaders) all[{shader.architecture, shader.name()}] = &shader;
    return all;
}

/// More of all others is worse.
bool isBetterHigher(const std::string& statistic) { return statistic == "Subgroups per SIMD"; }

std::string share(double before, double after) {
    if (before == 0) return after == 0 ? "0.00 %" : "new";
    return fmt::format("{:+.2f} %", 100 * (after / before - 1));
}

std::string change(const std::string& statistic, double before, double after) {
    return fmt::format("{} {:.10g} → {:.10g} ({})", statistic, before, after, share(before, after));
}

/// What the compiler gives, and what is executed in waves of 64 where both lists count it.
std::vector<std::tuple<std::string, double, double>> pairs(const ShaderCost& before, const ShaderCost& after) {
    std::vector<std::tuple<std::string, double, double>> all;
    for (const auto& [statistic, value] : after.statistics)
        all.emplace_back(statistic, static_cast<double>(before.of(statistic)), static_cast<double>(value));
    if (before.executed && after.executed)
        all.emplace_back("executed cycles", before.executed->cycles64, after.executed->cycles64);
    return all;
}

/// Of one statistic on one architecture.
struct Total {
    double before = 0, after = 0;
    int helped = 0, hurt = 0;
};

class Comparison {
public:
    Comparison(const ShaderCosts& before, const ShaderCosts& after) : before_(byName(before)), after_(byName(after)) {
        for (const ShaderCost& shader : after.shaders) {
            const auto known = before_.find({shader.architecture, shader.name()});
            if (known == before_.end())
                new_.insert(shader.name());
            else
                compare(*known->second, shader);
        }
        for (const ShaderCost& shader : before.shaders)
            if (!after_.contains({shader.architecture, shader.name()})) gone_.insert(shader.name());
    }

    [[nodiscard]] std::string text() const {
        std::string all;
        for (const auto& [key, total] : totals_)
            if (total.helped + total.hurt > 0)
                all += fmt::format("{}: total {}; helped {}, hurt {}\n", key.first,
                                   change(key.second, total.before, total.after), total.helped, total.hurt);
        all += changed_;
        for (const std::string& name : new_) all += "new: " + name + "\n";
        for (const std::string& name : gone_) all += "gone: " + name + "\n";
        return all.empty() ? fmt::format("no change in {} shaders\n", after_.size()) : all;
    }

private:
    void compare(const ShaderCost& before, const ShaderCost& after) {
        std::string changes;
        for (const auto& [statistic, was, value] : pairs(before, after)) {
            Total& total = totals_[{after.architecture, statistic}];
            total.before += was;
            total.after += value;
            if (was == value) continue;
            const bool worse = (value > was) != isBetterHigher(statistic);
            ++(worse ? total.hurt : total.helped);
            changes += (changes.empty() ? "" : ", ") + change(statistic, was, value);
        }
        if (!changes.empty()) changed_ += fmt::format("{}: {}: {}\n", after.architecture, after.name(), changes);
    }

    ByName before_, after_;
    std::map<std::pair<std::string, std::string>, Total> totals_;
    std::string changed_;
    std::set<std::string> new_, gone_;
};

} // namespace

std::string changes(const ShaderCosts& before, const ShaderCosts& after) {
    std::string other;
    if (before.compiler != after.compiler)
        other = fmt::format("another compiler: {} before, {} after; all changes may be its own\n", before.compiler,
                            after.compiler);
    return other + Comparison(before, after).text();
}

} // namespace shadowbench::shaders
