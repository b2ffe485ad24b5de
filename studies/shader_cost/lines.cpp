#include "studies/shader_cost/lines.h"

#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::shaders {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const gpu::Extents& extents) {
    Json all = Json::array();
    for (const auto& [size, times] : extents) all.push_back({size.first, size.second, times});
    return all;
}

gpu::Extents extentsOf(const Json& json) {
    gpu::Extents extents;
    for (const Json& each : json) extents[{each.at(0).get<int>(), each.at(1).get<int>()}] = each.at(2).get<std::uint64_t>();
    return extents;
}

Json jsonOf(const Output& output) {
    return {{"colours", output.colours},
            {"blends", output.blends},
            {"depth", output.depth},
            {"writes_depth", output.writesDepth},
            {"extents", jsonOf(output.extents)}};
}

Output outputOf(const Json& json) {
    return {json.at("colours").get<std::vector<std::string>>(), json.at("blends").get<bool>(),
            json.at("depth").get<std::string>(), json.at("writes_depth").get<bool>(), extentsOf(json.at("extents"))};
}

Json jsonOf(const gpu::WavePasses& passes) {
    return {passes.quads, passes.waves32, passes.waves64, passes.longest32, passes.longest64};
}

gpu::WavePasses passesOf(const Json& json) {
    gpu::WavePasses passes;
    json.at(0).get_to(passes.quads);
    json.at(1).get_to(passes.waves32);
    json.at(2).get_to(passes.waves64);
    json.at(3).get_to(passes.longest32);
    json.at(4).get_to(passes.longest64);
    return passes;
}

Json jsonOf(const gpu::Executed& executed) {
    return {
        {"cycles_32", executed.cycles32},   {"cycles_64", executed.cycles64},         {"longest_32", executed.longest32},
        {"longest_64", executed.longest64}, {"texture_reads", executed.textureReads}, {"buffer_reads", executed.bufferReads},
        {"stores", executed.stores}};
}

gpu::Executed executedOf(const Json& json) {
    return {json.at("cycles_32").get<double>(),     json.at("cycles_64").get<double>(),
            json.at("longest_32").get<double>(),    json.at("longest_64").get<double>(),
            json.at("texture_reads").get<double>(), json.at("buffer_reads").get<double>(),
            json.at("stores").get<double>()};
}

Json jsonOf(const FrameMove& move) {
    return {{"technique", move.technique},  {"scene", move.scene},   {"pass", move.pass},
            {"move", gpu::name(move.kind)}, {"format", move.format}, {"extents", jsonOf(move.extents)}};
}

FrameMove moveOf(const Json& json) {
    return {json.at("technique").get<std::string>(), json.at("scene").get<std::string>(),
            json.at("pass").get<std::string>(),      gpu::moveNamed(json.at("move").get<std::string>()),
            json.at("format").get<std::string>(),    extentsOf(json.at("extents"))};
}

Json jsonOf(const ShaderCost& shader, const std::string& compiler) {
    Json statistics = Json::object();
    for (const auto& [statistic, value] : shader.statistics) statistics[statistic] = value;
    Json json{{"technique", shader.technique},
              {"scene", shader.scene},
              {"pass", shader.pass},
              {"stage", gpu::name(shader.stage)},
              {"source", shader.source},
              {"number", shader.number},
              {"draws", shader.draws},
              {"architecture", shader.architecture},
              {"compiler", compiler},
              {"statistics", statistics},
              {"output", jsonOf(shader.output)}};
    if (!shader.frame.empty()) json["frame"] = shader.frame;
    if (shader.executed) json["executed"] = jsonOf(*shader.executed);
    if (shader.marks > 0) json["marks"] = shader.marks;
    if (shader.larger)
        json["larger"] = {{"extents", jsonOf(shader.larger->extents)}, {"executed", jsonOf(shader.larger->executed)}};
    return json;
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
    if (json.contains("frame")) json.at("frame").get_to(shader.frame);
    if (json.contains("executed")) shader.executed = executedOf(json.at("executed"));
    if (json.contains("marks")) json.at("marks").get_to(shader.marks);
    if (json.contains("larger"))
        shader.larger = {extentsOf(json.at("larger").at("extents")), executedOf(json.at("larger").at("executed"))};
    if (json.contains("output")) shader.output = outputOf(json.at("output"));
    return shader;
}

} // namespace

std::string ShaderCost::name() const { return technique.empty() ? place() : technique + " " + place(); }

std::string ShaderCost::place() const {
    std::string all = pass;
    for (const std::string& part : {std::string(gpu::name(stage)), source})
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
    for (const FrameMove& move : costs.moves) lines += jsonOf(move).dump() + "\n";
    return lines;
}

ShaderCosts parseLines(const std::string& text, const std::string& name) {
    ShaderCosts costs;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        try {
            const Json json = Json::parse(line);
            if (json.contains("move")) {
                costs.moves.push_back(moveOf(json));
                continue;
            }
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

std::string toText(const FrameList& list) {
    Json pipelines = Json::array(), moves = Json::array();
    for (const FramePipeline& pipeline : list.pipelines) {
        Json shaders = Json::array();
        for (const auto& [stage, source] : pipeline.shaders) shaders.push_back({gpu::name(stage), source});
        pipelines.push_back({{"pass", pipeline.pass},
                             {"draws", pipeline.draws},
                             {"digest", pipeline.digest},
                             {"shaders", shaders},
                             {"output", jsonOf(pipeline.output)},
                             {"passes", jsonOf(pipeline.passes)}});
        if (pipeline.larger)
            pipelines.back()["larger"] = {{"extents", jsonOf(pipeline.larger->first)},
                                          {"passes", jsonOf(pipeline.larger->second)}};
    }
    for (const FrameMove& move : list.moves) moves.push_back(jsonOf(move));
    return Json{{"frame", list.frame}, {"pipelines", pipelines}, {"moves", moves}}.dump();
}

FrameList frameList(const std::string& text) {
    try {
        FrameList list;
        const Json json = Json::parse(text);
        json.at("frame").get_to(list.frame);
        for (const Json& each : json.at("pipelines")) {
            FramePipeline& pipeline = list.pipelines.emplace_back();
            each.at("pass").get_to(pipeline.pass);
            each.at("draws").get_to(pipeline.draws);
            each.at("digest").get_to(pipeline.digest);
            for (const Json& shader : each.at("shaders"))
                pipeline.shaders.emplace_back(gpu::stageNamed(shader.at(0).get<std::string>()), shader.at(1));
            pipeline.output = outputOf(each.at("output"));
            pipeline.passes = passesOf(each.at("passes"));
            if (each.contains("larger"))
                pipeline.larger = {extentsOf(each.at("larger").at("extents")), passesOf(each.at("larger").at("passes"))};
        }
        for (const Json& each : json.at("moves")) list.moves.push_back(moveOf(each));
        return list;
    } catch (const Json::exception& error) {
        throw BadInput(std::string("a list of pipelines cannot be read: ") + error.what());
    }
}

} // namespace shadowbench::shaders
