#include "harness/cli/run_result.h"

#include "harness/cli/written_report.h"
#include "harness/report/lod_report.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {
namespace {

/// Scene ids in the order of the records.
std::vector<std::string> scenesOf(const std::vector<Record>& records) {
    std::vector<std::string> scenes;
    for (const Record& record : records)
        if (std::find(scenes.begin(), scenes.end(), record.scene) == scenes.end()) scenes.push_back(record.scene);
    return scenes;
}

} // namespace

ExitCode reportResult(const RunResult& result, const std::filesystem::path& out) {
    const report::Written written = report::writeReport(result.records, out);
    for (const std::string& scene : scenesOf(result.records)) {
        fmt::print("{}\n", report::terminalTable(result.records, scene));
        const std::string lod = report::lodTerminalTable(result.records, scene);
        if (!lod.empty()) fmt::print("{}\n", lod);
    }
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    fmt::print("records: {}\n", (out / "results.jsonl").string());
    print(written);
    return result.code;
}

} // namespace shadowbench
