#include "harness/runs/cell_file.h"

#include "base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench::shards {
namespace {

using Json = nlohmann::ordered_json;

MeasuredCell parse(const std::string& text) {
    const Json json = Json::parse(text);
    MeasuredCell cell;
    json.at("id").get_to(cell.id);
    cell.code = static_cast<ExitCode>(json.at("exit_code").get<int>());
    cell.record = parseRecord(json.at("record").dump());
    return cell;
}

} // namespace

std::string text(const MeasuredCell& cell) {
    const Json json{
        {"id", cell.id}, {"exit_code", static_cast<int>(cell.code)}, {"record", Json::parse(toJson(cell.record))}};
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
