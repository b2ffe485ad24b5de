#include "gpu/figures.h"

#include "base/error.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace shadowbench::gpu {
std::uint64_t StageFigures::of(const std::string& statistic) const {
    const auto found = std::ranges::find(statistics, statistic, &std::pair<std::string, std::uint64_t>::first);
    return found == statistics.end() ? 0 : found->second;
}

std::string toText(const std::vector<StageFigures>& figures) {
    auto json = nlohmann::ordered_json::array();
    for (const StageFigures& each : figures) {
        nlohmann::ordered_json statistics;
        for (const auto& [statistic, value] : each.statistics) statistics[statistic] = value;
        json.push_back({{"stage", name(each.stage)}, {"statistics", statistics}});
    }
    return json.dump();
}

std::vector<StageFigures> figuresOf(const std::string& text) {
    try {
        std::vector<StageFigures> figures;
        for (const auto& each : nlohmann::ordered_json::parse(text)) {
            StageFigures& stage = figures.emplace_back(StageFigures{stageNamed(each.at("stage").get<std::string>()), {}});
            for (const auto& [statistic, value] : each.at("statistics").items())
                stage.statistics.emplace_back(statistic, value);
        }
        return figures;
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(std::string("figures of a shader cannot be read: ") + error.what());
    }
}

} // namespace shadowbench::gpu
