// Before and after, as Mesa's shader-db reports them.
#include "studies/shader_cost/compared.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

namespace shadowbench::shaders {
namespace {

/// What tells shaders apart, on one architecture.
using Key = std::string (*)(const ShaderCost&);

constexpr std::array<Key, 3> keys{
    [](const ShaderCost& s) { return fmt::format("{} {}", s.architecture, s.name()); },
    [](const ShaderCost& s) {
        return fmt::format("{} {} {} {}", s.architecture, s.technique, gpu::name(s.stage), s.source);
    },
    [](const ShaderCost& s) { return fmt::format("{} {} {} {}", s.architecture, s.technique, s.pass, gpu::name(s.stage)); },
};

/// By a key that two of them share there is none.
std::map<std::string, const ShaderCost*> byKey(const std::vector<const ShaderCost*>& shaders, Key key) {
    std::map<std::string, const ShaderCost*> all;
    for (const ShaderCost* shader : shaders)
        if (const auto [place, isFirst] = all.try_emplace(key(*shader), shader); !isFirst) place->second = nullptr;
    return all;
}

std::vector<const ShaderCost*> pointersTo(const std::vector<ShaderCost>& shaders) {
    std::vector<const ShaderCost*> all;
    for (const ShaderCost& shader : shaders) all.push_back(&shader);
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
std::vector<std::tuple<std::string, double, double>> pairs(const SharedShader& shader) {
    std::vector<std::tuple<std::string, double, double>> all;
    for (const auto& [statistic, value] : shader.after->statistics)
        all.emplace_back(statistic, static_cast<double>(shader.before->of(statistic)), static_cast<double>(value));
    if (shader.isCounted())
        all.emplace_back("executed cycles", shader.before->executed->cycles64, shader.after->executed->cycles64);
    return all;
}

/// Of one statistic on one architecture.
struct Total {
    double before = 0, after = 0;
    int helped = 0, hurt = 0;
};

class Comparison {
public:
    explicit Comparison(const ComparedShaders& shaders) : shaders_(shaders) {
        for (const SharedShader& shader : shaders.both) add(shader);
        for (const ShaderCost* shader : shaders.added) new_.insert(shader->name());
        for (const ShaderCost* shader : shaders.gone) gone_.insert(shader->name());
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
        return all.empty() ? fmt::format("no change in {} shaders\n", shaders_.both.size()) : all;
    }

private:
    void add(const SharedShader& shader) {
        const ShaderCost& after = *shader.after;
        std::string changes;
        for (const auto& [statistic, was, value] : pairs(shader)) {
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

    const ComparedShaders& shaders_;
    std::map<std::pair<std::string, std::string>, Total> totals_;
    std::string changed_;
    std::set<std::string> new_, gone_;
};

} // namespace

bool SharedShader::isCounted() const {
    return before->executed && after->executed && before->scene == after->scene && before->frame == after->frame;
}

bool SharedShader::isRewritten() const { return before->marks != after->marks; }

ComparedShaders compared(const ShaderCosts& before, const ShaderCosts& after) {
    std::vector<const ShaderCost*> gone = pointersTo(before.shaders), added = pointersTo(after.shaders);
    std::map<const ShaderCost*, const ShaderCost*> partners; // by what is after
    for (const Key key : keys) {
        const auto was = byKey(gone, key), is = byKey(added, key);
        for (const auto& [word, shader] : is)
            if (const auto found = was.find(word); shader != nullptr && found != was.end() && found->second != nullptr)
                partners[shader] = found->second;
        std::erase_if(added, [&](const ShaderCost* shader) { return partners.contains(shader); });
        std::set<const ShaderCost*> known;
        for (const auto& [shader, partner] : partners) known.insert(partner);
        std::erase_if(gone, [&](const ShaderCost* shader) { return known.contains(shader); });
    }
    ComparedShaders all{{}, std::move(gone), std::move(added)};
    for (const ShaderCost& shader : after.shaders)
        if (const auto partner = partners.find(&shader); partner != partners.end())
            all.both.push_back({partner->second, &shader});
    return all;
}

std::string changes(const ShaderCosts& before, const ShaderCosts& after) {
    std::string other;
    if (before.compiler != after.compiler)
        other = fmt::format("another compiler: {} before, {} after; all changes may be its own\n", before.compiler,
                            after.compiler);
    return other + Comparison(compared(before, after)).text();
}

} // namespace shadowbench::shaders
