#include "cli/run_result.h"

#include "base/error.h"
#include "harness/cells/kept_images.h"
#include "harness/cells/renderer_log.h"
#include "report/lod_report.h"
#include "report/summary.h"
#include "report/terminal_summary.h"
#include "site/site.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {

namespace {

void printError(const Record& record, const std::filesystem::path& out) {
    fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    if (!isExternal(record) || !isFolderName(record.scene)) return;
    const std::filesystem::path log = rendererLog(out / "logs", record.scene, record.variant);
    const std::vector<std::string> lines = lastLines(log);
    if (!lines.empty()) fmt::print(stderr, "  {}\nall of its output: {}\n", fmt::join(lines, "\n  "), log.string());
}

void requireApplicable(const std::vector<Record>& records) {
    if (records.empty() ||
        !std::ranges::all_of(records, [](const Record& record) { return record.status == Status::NotApplicable; }))
        return;
    std::vector<std::string> reasons;
    for (const Record& record : records)
        reasons.push_back(fmt::format("{} on {}: {}", record.variant, record.scene, record.reason));
    throw BadInput(fmt::format("no technique of this run applies to its scene; {}", fmt::join(reasons, "; ")));
}

} // namespace

void printTables(const std::vector<Record>& records, const std::filesystem::path& out, const ResultOptions& options) {
    const report::Rows rows = options.everyRow ? report::Rows::All : report::Rows::Front;
    const std::vector<Record> shown = options.standing ? report::standing(records) : records;
    for (const std::string& scene : report::scenes(shown)) {
        for (const std::string& table : {report::terminalSummary(shown, scene, (out / "index.html").string(), rows),
                                         report::lodTerminalTable(shown, scene)})
            if (!table.empty()) fmt::print("{}\n", table);
    }
    std::fflush(stdout);
}

ExitCode reportResult(const RunResult& result, const std::filesystem::path& out, const ResultOptions& options) {
    if (!options.printed) printTables(result.records, out, options);
    for (const Record& record : result.records)
        if (record.status == Status::Error) printError(record, out);
    fmt::print("records: {}\n", (out / "results.jsonl").string());
    std::fflush(stdout); // pages take a while, and need a program that may be missing
    const std::filesystem::path page =
        site::writeSite({.records = result.records, .images = out / "images", .standing = options.standing}, out);
    fmt::print("page: {}\n", page.string());
    requireApplicable(result.records);
    return result.code;
}

} // namespace shadowbench
