#include "harness/runs/cell_file.h"

#include "base/files.h"
#include "base/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace shadowbench::shards {
namespace {

using Json = nlohmann::ordered_json;

ExitCode exitCode(const Json& json) {
    const int number = wholeNumber<int>(json);
    for (const ExitCode code : {ExitCode::Pass, ExitCode::Internal, ExitCode::BadInput, ExitCode::CostRegression,
                                ExitCode::AccuracyRegression, ExitCode::Inconclusive, ExitCode::Transient})
        if (static_cast<int>(code) == number) return code;
    throw BadInput(fmt::format("{} is no exit code", number));
}

MeasuredCell parse(const std::string& text) {
    const Json json = Json::parse(boundedJson(text, "its text"));
    MeasuredCell cell;
    json.at("id").get_to(cell.id);
    cell.code = exitCode(json.at("exit_code"));
    cell.transient = json.contains("transient");
    cell.record = parseRecord(json.at("record").dump());
    return cell;
}

} // namespace

std::string text(const MeasuredCell& cell) {
    Json json{{"id", cell.id}, {"exit_code", static_cast<int>(cell.code)}, {"record", Json::parse(toJson(cell.record))}};
    if (cell.transient) json["transient"] = true;
    return json.dump();
}

MeasuredCell measuredCell(const std::string& text) {
    try {
        return parse(text);
    } catch (const Json::exception& error) {
        throw BadInput(error.what());
    }
}

std::filesystem::path cellFile(const std::filesystem::path& folder, const std::string& id) {
    return folder / "cells" / (id + ".json");
}

void writeCell(const std::filesystem::path& folder, const MeasuredCell& cell) {
    writeFile(cellFile(folder, cell.id), text(cell) + "\n");
}

std::vector<MeasuredCell> readCells(const std::filesystem::path& folder) {
    std::set<std::string> ids;
    for (const auto& file : std::filesystem::directory_iterator(cellFile(folder, "").parent_path()))
        if (file.path().extension() == ".json") ids.insert(file.path().stem());
    std::vector<MeasuredCell> cells;
    for (const std::string& id : ids) cells.push_back(*readCell(folder, id));
    return cells;
}

std::optional<MeasuredCell> readCell(const std::filesystem::path& folder, const std::string& id) {
    const std::filesystem::path file = cellFile(folder, id);
    if (!std::filesystem::exists(file)) return {};
    const std::string content = readFile(file);
    const auto refuse = [&](std::string_view reason) {
        return BadInput(fmt::format("{} holds no measured cell: {}", file.string(), reason));
    };
    try {
        MeasuredCell cell = measuredCell(content);
        if (cell.id != id) throw refuse("its id is " + cell.id);
        return cell;
    } catch (const BadInput& error) {
        throw refuse(error.what());
    }
}

} // namespace shadowbench::shards
