#include "benchmarks/timed_evaluations.h"

#include "base/error.h"
#include "base/files.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::benchmarks {
namespace {

using nlohmann::json;

/// To 0.1 µs: finer is noise, and takes room.
double rounded(double milliseconds) { return std::round(milliseconds * 1e4) / 1e4; }

json toJson(const gate::PairedSamples& samples) {
    json restarts = json::array();
    for (const auto& rounds : samples.restarts) {
        json list = json::array();
        for (const gate::PairedRound& round : rounds) {
            json times = json::array();
            for (const timing::FrameTime& time : {round.base, round.head, round.control})
                times.insert(times.end(), {rounded(time.cpu), rounded(time.wall)});
            list.push_back(std::move(times));
        }
        restarts.push_back(std::move(list));
    }
    return {{"frames_per_turn", samples.framesPerTurn}, {"restarts", std::move(restarts)}};
}

gate::PairedSamples samplesFrom(const json& object) {
    gate::PairedSamples samples;
    samples.framesPerTurn = object.at("frames_per_turn").get<int>();
    for (const json& rounds : object.at("restarts")) {
        samples.restarts.emplace_back();
        for (const json& t : rounds)
            samples.restarts.back().push_back({{t.at(0).get<double>(), t.at(1).get<double>()},
                                               {t.at(2).get<double>(), t.at(3).get<double>()},
                                               {t.at(4).get<double>(), t.at(5).get<double>()}});
    }
    return samples;
}

std::string lineOf(const Evaluation& evaluation) {
    json cells = json::array();
    for (const MeasuredCell& measured : evaluation.cells) {
        json cell = toJson(measured.samples);
        cell["scene"] = measured.cell.scene;
        cell["variant"] = measured.cell.variant;
        cells.push_back(std::move(cell));
    }
    const json object{{"seed", evaluation.seed},
                      {"same_programs", evaluation.samePrograms},
                      {"loaders", evaluation.loaders},
                      {"load_average", evaluation.loadAverage},
                      {"cells", std::move(cells)}};
    return object.dump() + '\n';
}

Evaluation evaluationFrom(const std::string& line) {
    const json object = json::parse(line);
    Evaluation evaluation{object.at("seed").get<std::uint32_t>(),
                          object.at("same_programs").get<bool>(),
                          object.at("loaders").get<int>(),
                          object.at("load_average").get<double>(),
                          {}};
    for (const json& cell : object.at("cells"))
        evaluation.cells.push_back(
            {{cell.at("scene").get<std::string>(), cell.at("variant").get<std::string>()}, samplesFrom(cell)});
    return evaluation;
}

} // namespace

std::vector<Evaluation> readEvaluations(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return {};
    std::vector<Evaluation> evaluations;
    std::istringstream lines(readFile(file));
    for (std::string line; std::getline(lines, line) && !lines.eof();) { // only a line that was cut short ends with the file
        try {
            evaluations.push_back(evaluationFrom(line));
        } catch (const json::exception& error) {
            throw BadInput(
                fmt::format("{}: line {} is no evaluation: {}", file.string(), evaluations.size() + 1, error.what()));
        }
    }
    return evaluations;
}

void appendEvaluation(const std::filesystem::path& file, const Evaluation& evaluation) {
    std::string text;
    for (const Evaluation& earlier : readEvaluations(file)) text += lineOf(earlier);
    writeFile(file, text + lineOf(evaluation));
}

} // namespace shadowbench::benchmarks
