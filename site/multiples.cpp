#include "site/multiples.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::site {

Multiples::Multiples(const std::vector<Record>& records) : records_(records) {
    for (const std::string& scene : report::scenes(records))
        if (costing_ = report::shownCosting(records, scene); !costing_.card.empty()) break;
    for (const Record& record : records)
        if (record.variant == "sm-uniform")
            if (const auto cost = costing_.of(record)) uniform_.try_emplace(record.scene, cost->ratio);
}

std::optional<double> Multiples::of(const Record& record) const {
    const auto cost = costing_.of ? costing_.of(record) : std::nullopt;
    if (!cost || cost->ratio <= 0) return {};
    if (costing_.card.empty()) return cost->ratio; // of sm-uniform's frames, which were timed beside
    const auto uniform = uniform_.find(record.scene);
    if (uniform == uniform_.end()) return {};
    return cost->ratio / uniform->second;
}

std::optional<double> Multiples::mean(const std::string& variant, const std::vector<std::string>& scenes) const {
    double logarithms = 0;
    int count = 0;
    for (const Record& record : records_) {
        if (record.variant != variant || std::ranges::find(scenes, record.scene) == scenes.end()) continue;
        if (const std::optional<double> multiple = of(record)) {
            logarithms += std::log(*multiple);
            ++count;
        }
    }
    if (count == 0) return {};
    return std::exp(logarithms / count);
}

std::string Multiples::where() const {
    return costing_.card.empty() ? "measured here" : "modelled on " + report::cardAndSize(costing_.card);
}

} // namespace shadowbench::site
