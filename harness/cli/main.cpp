// The command line: parses, calls the chosen verb, turns errors into one line and a documented exit code.
#include "base/files.h"
#include "base/one_line.h"
#include "harness/cells/environment.h"
#include "harness/cli/command.h"
#include "harness/cli/documents.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace {

/// CLI11 says "was not expected" of a misspelt verb; a person wants the near matches. `words` are what follows `app`.
void requireKnownVerb(const CLI::App& app, const std::vector<std::string>& words) {
    const std::vector<const CLI::App*> verbs = app.get_subcommands({});
    if (verbs.empty() || words.empty() || words.front().starts_with('-')) return;
    std::vector<std::string> names;
    for (const CLI::App* verb : verbs) {
        if (verb->get_name() == words.front()) return requireKnownVerb(*verb, {words.begin() + 1, words.end()});
        names.push_back(verb->get_name());
    }
    throw BadInput(fmt::format("there is no verb \"{}\"{}; the verbs are: {}", words.front(),
                               didYouMean(words.front(), names), fmt::join(names, ", ")));
}

ExitCode dispatch(int argc, char** argv) {
    CLI::App app("shadowbench scores real-time shadow techniques against proven ground truth.", "shadowbench");
    app.require_subcommand(1);
    app.set_version_flag("--version", "shadowbench " + programVersion());
    app.footer(
        "Exit codes: 0 pass, 1 internal, 2 usage or bad input, 3 cost regression, 4 accuracy or stability regression, "
        "5 inconclusive.\nEvery verb has --help with an example.");

    Action action;
    for (const auto& add : {addList, addRun, addMerge, addScore, addReference, addSweep, addRecommend, addClaims, addPapers,
                            addExport, addCompare, addGate, addHistory, addCache, addReport, addCountFrames, addTimeFrames})
        add(app, action);
    addDocuments(app, action);

    requireKnownVerb(app, {argv + std::min(argc, 1), argv + argc});
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw BadInput(error.what());
        app.exit(error); // prints --help or --version
        return ExitCode::Pass;
    }
    return action();
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    using shadowbench::ExitCode;
    try {
        return static_cast<int>(shadowbench::dispatch(argc, argv));
    } catch (const shadowbench::Error& error) {
        const bool isOurs = error.code() == ExitCode::Internal; // a shader's log has lines; words of an input may have any
        fmt::print(stderr, "shadowbench: {}\n", isOurs ? error.what() : shadowbench::onOneLine(error.what()));
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "shadowbench: internal error: {}\n", error.what());
        return static_cast<int>(ExitCode::Internal);
    }
}
