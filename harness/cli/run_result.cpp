#include "harness/cli/run_result.h"

#include "harness/cli/written_report.h"
#include "harness/report/lod_report.h"
#include "harness/report/summary.h"
#include "harness/report/terminal_summary.h"

#include <fmt/format.h>

namespace shadowbench {

ExitCode reportResult(const RunResult& result, const std::filesystem::path& out) {
    const report::Written written = report::writeReport(result.records, out);
    for (const std::string& scene : report::scenes(result.records)) {
        for (const std::string& table : {report::terminalSummary(result.records, scene, written.page.string()),
                                         report::lodTerminalTable(result.records, scene)})
            if (!table.empty()) fmt::print("{}\n", table);
    }
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    fmt::print("records: {}\n", (out / "results.jsonl").string());
    printFiles(written);
    return result.code;
}

} // namespace shadowbench
