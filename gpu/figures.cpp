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
        json.push_back({{"stage", name(each.stage)},
                        {"statistics", statistics},
                        {"waves", each.waves},
                        {"guessed", each.guessed.parts}});
    }
    return json.dump();
}

std::vector<StageFigures> figuresOf(const std::string& text) {
    try {
        std::vector<StageFigures> figures;
        for (const auto& each : nlohmann::ordered_json::parse(text)) {
            StageFigures& stage = figures.emplace_back(StageFigures{stageNamed(each.at("stage").get<std::string>()), {}});
            each.at("waves").get_to(stage.waves);
            each.at("guessed").get_to(stage.guessed.parts);
            for (const auto& [statistic, value] : each.at("statistics").items())
                stage.statistics.emplace_back(statistic, value);
        }
        return figures;
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(std::string("figures of a shader cannot be read: ") + error.what());
    }
}

std::string toText(const std::vector<Busy>& marks) {
    auto json = nlohmann::json::array();
    for (const Busy& busy : marks) json.push_back(busy.parts);
    return json.dump();
}

std::vector<Busy> busyOf(const std::string& text) {
    try {
        std::vector<Busy> marks;
        for (const auto& each : nlohmann::json::parse(text)) each.get_to(marks.emplace_back().parts);
        return marks;
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(std::string("what marks of a shader execute cannot be read: ") + error.what());
    }
}

} // namespace shadowbench::gpu
