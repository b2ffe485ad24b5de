#include "harness/cli/run_result.h"

#include "harness/report/lod_report.h"
#include "harness/report/site/site.h"
#include "harness/report/summary.h"
#include "harness/report/terminal_summary.h"

#include <cstdio>
#include <fmt/format.h>

namespace shadowbench {

ExitCode reportResult(const RunResult& result, const std::filesystem::path& out, bool standing) {
    const std::vector<Record> shown = standing ? report::standing(result.records) : result.records;
    for (const std::string& scene : report::scenes(shown)) {
        for (const std::string& table :
             {report::terminalSummary(shown, scene, (out / "index.html").string()), report::lodTerminalTable(shown, scene)})
            if (!table.empty()) fmt::print("{}\n", table);
    }
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    fmt::print("records: {}\n", (out / "results.jsonl").string());
    std::fflush(stdout); // pages take a while, and need a program that may be missing
    const std::filesystem::path page =
        site::writeSite({.records = result.records, .images = out / "images", .standing = standing}, out);
    fmt::print("page: {}\n", page.string());
    return result.code;
}

} // namespace shadowbench
