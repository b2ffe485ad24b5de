#include "cli/gate_result.h"

#include "base/files.h"
#include "gate/gate_report.h"
#include "gate/sarif.h"
#include "gate/verdict.h"
#include "site/gate_site.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace shadowbench {

void addGateFiles(CLI::App& verb, GateFiles& files) {
    verb.add_option("--junit", files.junit, "Write the verdicts as JUnit XML");
    verb.add_option("--sarif", files.sarif, "Write what is worse as SARIF 2.1.0, at the renderers' files");
    verb.add_option("--summary", files.summary,
                    "Write the verdict and the worst there, in 40 lines of Markdown at most (a comment)");
    verb.add_flag("--annotations", files.annotations, "Print what is worse as CI annotations, too");
}

ExitCode writeGate(const gate::GateResult& result, const gate::GateOptions& shown, const GateFiles& files,
                   const std::filesystem::path& root) {
    if (!files.summary.empty()) writeFile(files.summary, gate::gateComment(result, shown));
    if (!files.junit.empty()) writeFile(files.junit, gate::junit(result.changes, result.notCompared));
    if (!files.sarif.empty()) writeFile(files.sarif, gate::sarif(result, shown, root));
    fmt::print("{}page: {}\n", gate::gateReport(result, shown), site::writeGateSite(result, shown).string());
    if (files.annotations) fmt::print("{}", gate::annotations(result.changes, result.notCompared));
    return result.code();
}

} // namespace shadowbench
