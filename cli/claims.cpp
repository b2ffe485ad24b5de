#include "studies/claims/claims.h"

#include "cli/command.h"
#include "harness/records/comparability.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct ClaimsOptions {
    std::vector<std::filesystem::path> records{"results/latest/results.jsonl"};
    std::string format = "text";
};

ExitCode printClaims(const ClaimsOptions& options) {
    const std::vector<Record> records = gate::readOfOneDevice(options.records);
    std::vector<Judgement> judgements;
    for (const Claim& claim : claims()) judgements.push_back(judge(claim, records));
    fmt::print("{}", claimsReport(judgements, options.format));
    return ExitCode::Pass;
}

} // namespace

void addClaims(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ClaimsOptions>();
    CLI::App* verb = app.add_subcommand("claims", "Judges the papers' claims by records");
    verb->footer("Example:\n  shadowbench claims results/published/results.jsonl results/sweep/sweep.jsonl --format md");
    verb->add_option("records", options->records, "Record files of run and sweep")->capture_default_str();
    verb->add_option("--format", options->format, "text, md or json")
        ->check(CLI::IsMember({"text", "md", "json"}))
        ->capture_default_str();
    verb->callback([&action, options] { action = [options] { return printClaims(*options); }; });
}

} // namespace shadowbench
