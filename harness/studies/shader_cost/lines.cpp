#include "harness/studies/shader_cost/lines.h"

#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::shaders {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const ShaderCost& shader, const std::string& compiler) {
    Json statistics = Json::object();
    for (const auto& [statistic, value] : shader.statistics) statistics[statistic] = value;
    return {{"technique", shader.technique}, {"scene", shader.scene},
            {"pass", shader.pass},           {"stage", gpu::name(shader.stage)},
            {"source", shader.source},       {"number", shader.number},
            {"draws", shader.draws},         {"architecture", shader.architecture},
            {"compiler", compiler},          {"statistics", statistics}};
}

ShaderCost shaderOf(const Json& json) {
    ShaderCost shader{};
    json.at("technique").get_to(shader.technique);
    json.at("scene").get_to(shader.scene);
    json.at("pass").get_to(shader.pass);
    shader.stage = gpu::stageNamed(json.at("stage").get<std::string>());
    json.at("source").get_to(shader.source);
    json.at("number").get_to(shader.number);
    json.at("draws").get_to(shader.draws);
    json.at("architecture").get_to(shader.architecture);
    for (const auto& [statistic, value] : json.at("statistics").items())
        shader.statistics.emplace_back(statistic, value.get<std::uint64_t>());
    return shader;
}

} // namespace

std::string ShaderCost::name() const {
    std::string all = technique;
    for (const std::string& part : {pass, std::string(gpu::name(stage)), source})
        if (!part.empty()) all += (all.empty() ? "" : " ") + part;
    return number == 1 ? all : fmt::format("{} #{}", all, number);
}

std::uint64_t ShaderCost::of(const std::string& statistic) const {
    for (const auto& [known, value] : statistics)
        if (known == statistic) return value;
    return 0;
}

std::string toLines(const ShaderCosts& costs) {
    std::string lines;
    for (const ShaderCost& shader : costs.shaders) lines += jsonOf(shader, costs.compiler).dump() + "\n";
    return lines;
}

ShaderCosts parseLines(const std::string& text, const std::string& name) {
    ShaderCosts costs;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        try {
            const Json json = Json::parse(line);
            costs.shaders.push_back(shaderOf(json));
            costs.compiler = json.at("compiler").get<std::string>();
        } catch (const std::exception& error) {
            throw BadInput(fmt::format("line {} of {} is no shader's cost as shader-cost writes it ({}); name a file "
                                       "shader-cost.jsonl of an earlier run",
                                       number, name, error.what()));
        }
    }
    return costs;
}

ShaderCosts readLines(const std::filesystem::path& file) { return parseLines(readFile(file), file.string()); }

std::string toText(const std::vector<FramePipeline>& pipelines) {
    Json all = Json::array();
    for (const FramePipeline& pipeline : pipelines) {
        Json shaders = Json::array();
        for (const auto& [stage, source] : pipeline.shaders) shaders.push_back({gpu::name(stage), source});
        all.push_back(
            {{"pass", pipeline.pass}, {"draws", pipeline.draws}, {"digest", pipeline.digest}, {"shaders", shaders}});
    }
    return all.dump();
}

std::vector<FramePipeline> framePipelines(const std::string& text) {
    try {
        std::vector<FramePipeline> pipelines;
        for (const Json& json : Json::parse(text)) {
            FramePipeline& pipeline = pipelines.emplace_back();
            json.at("pass").get_to(pipeline.pass);
            json.at("draws").get_to(pipeline.draws);
            json.at("digest").get_to(pipeline.digest);
            for (const Json& shader : json.at("shaders"))
                pipeline.shaders.emplace_back(gpu::stageNamed(shader.at(0).get<std::string>()), shader.at(1));
        }
        return pipelines;
    } catch (const Json::exception& error) {
        throw BadInput(std::string("a list of pipelines cannot be read: ") + error.what());
    }
}

} // namespace shadowbench::shaders
