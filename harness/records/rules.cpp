#include "harness/records/rules.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

Limit limitOf(const metrics::Allowance& a) {
    return {a.truth, a.pixels, std::string(a.of), a.relative, a.absolute, a.magnitude, a.best, a.absent};
}

Rules rulesOfTheTable() {
    Rules rules;
    for (const metrics::Metric& metric : metrics::table)
        if (metric.allowance) rules.limits.emplace(metric.path, limitOf(*metric.allowance));
    return rules;
}

/// Calls use(name, base's number, head's number) for each number of two rules or two limits.
void forBoth(const auto& base, auto& head, const auto& use) {
    std::vector<double> before;
    const auto read = [&](const char*, double number) { before.push_back(number); };
    numbers(read, base);
    auto next = before.begin();
    const auto both = [&](const char* name, auto& number) { use(name, *next++, number); };
    numbers(both, head);
}

/// Whether both compare the same of a metric.
bool compareTheSame(const Limit& a, const Limit& b) {
    return a.of == b.of && a.magnitude == b.magnitude && a.best == b.best && a.absent == b.absent && a.truth == b.truth;
}

} // namespace

const Rules& ownRules() {
    static const Rules rules = rulesOfTheTable();
    return rules;
}

Rules stricter(const Rules& base, const Rules& head) {
    const auto least = [](const char*, double before, double& now) { now = std::min(before, now); };
    Rules result = head;
    forBoth(base, result, least);
    for (const auto& [path, before] : base.limits) {
        const auto [now, added] = result.limits.try_emplace(path, before);
        if (added) continue;
        Limit limit = now->second;
        forBoth(before, limit, least);
        limit.truth = std::min(limit.truth, before.truth);
        limit.of = before.of;
        limit.magnitude = before.magnitude || limit.magnitude;
        limit.best = before.best;
        limit.absent = before.absent;
        now->second = limit;
    }
    return result;
}

std::vector<std::string> loosened(const Rules& base, const Rules& head) {
    std::vector<std::string> sentences;
    const auto compareNumbers = [&](const std::string& of, const auto& before, const auto& now) {
        forBoth(before, now, [&](const char* name, double was, double is) {
            if (is > was) sentences.push_back(fmt::format("the allowance {}{} was {} and is {}", of, name, was, is));
        });
    };
    compareNumbers("", base, head);
    for (const auto& [path, before] : base.limits) {
        const auto now = head.limits.find(path);
        if (now == head.limits.end()) {
            sentences.push_back(fmt::format("{} is no longer judged", path));
            continue;
        }
        compareNumbers(path + ": ", before, now->second);
        if (!compareTheSame(before, now->second))
            sentences.push_back(fmt::format("what is compared of {} is another thing", path));
    }
    return sentences;
}

} // namespace shadowbench::gate
