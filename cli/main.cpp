// The command line: parses, calls the chosen verb, turns errors into one line and a documented exit code.
#include "base/last_words.h"
#include "base/one_line.h"
#include "base/words.h"
#include "cli/command.h"
#include "cli/documents.h"
#include "harness/cells/environment.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

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

/// Options that had another name are still read by it, with a line that says the new one.
void renameFormerOptions(std::vector<std::string>& words) {
    static const std::map<std::string, std::string, std::less<>> now{
        {"--aa", "--same-program"}, {"--as-it-is", "--force"}, {"--means", "--definition"}};
    for (std::string& word : words) {
        const std::size_t end = std::min(word.find('='), word.size());
        const auto found = now.find(word.substr(0, end));
        if (found == now.end()) continue;
        fmt::print(stderr, "shadowbench: {} is now called {}\n", found->first, found->second);
        word.replace(0, end, found->second);
    }
}

/// Names the first option that the verb lacks, with near matches: CLI11 names all the words that it cannot place.
void requireKnownOptions(const CLI::App& app, const std::vector<std::string>& words) {
    std::string verb;
    std::vector<std::string> known;
    for (const CLI::App* part = &app; part != nullptr;) { // of `history add` those of both
        for (const CLI::Option* option : part->get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        verb += (verb.empty() ? "" : " ") + part->get_name();
        const std::vector<CLI::App*> next = part->get_subcommands(); // that the words name
        part = next.empty() ? nullptr : next.front();
    }
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with("--") && std::ranges::find(known, name) == known.end())
            throw BadInput(
                fmt::format("{} has no option {}{}; {} --help names all", verb, name, didYouMean(name, known), verb));
    }
}

ExitCode dispatch(int argc, char** argv) {
    CLI::App app("shadowbench scores real-time shadow techniques against proven ground truth.", "shadowbench");
    app.require_subcommand(1);
    app.set_version_flag("--version", "shadowbench " + programVersion());
    app.footer(
        "Exit codes: 0 pass, 1 internal, 2 usage or bad input, 3 cost regression, 4 accuracy or stability regression, "
        "5 inconclusive.\nEvery verb has --help with an example.");

    Action action;
    for (const auto& add : {addList,       addInspect, addRun,    addMerge,        addScore,     addReference, addSweep,
                            addCauses,     addDevelop, addCheck,  addNewTechnique, addRecommend, addClaims,    addPapers,
                            addShaderCost, addGpuCost, addExport, addCompare,      addGate,      addCi,        addHistory,
                            addCache,      addReport,  addFigure, addCountFrames,  addTimeFrames})
        add(app, action);
    addDocuments(app, action);

    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    requireKnownVerb(app, words);
    renameFormerOptions(words);
    try {
        app.parse(std::vector(words.rbegin(), words.rend())); // as CLI11 takes them
    } catch (const CLI::ExtrasError& error) {
        requireKnownOptions(app, words);
        throw BadInput(error.what());
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw BadInput(error.what());
        std::ostringstream asked; // --help or --version
        app.exit(error, asked);
        fmt::print("{}", asked.str());
        return ExitCode::Pass;
    }
    return action();
}

/// Before objects with static storage are made, our own and the libraries', which may lack memory, too.
__attribute__((section(".preinit_array"), used)) void (*const beforeLibraries)() = sayWhyAborted;

[[noreturn]] void failToPrint(const char* stream, int error) {
    throw InternalError(fmt::format("cannot write to {}: {}; free some space or choose another place", stream,
                                    std::strerror(error != 0 ? error : EIO)));
}

/// What was printed is a result, too: where it could not be written, the program has not done what it was asked for.
void flushOutput() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) failToPrint("standard output", errno);
}

ExitCode dispatchAndFlush(int argc, char** argv) {
    try {
        const ExitCode code = dispatch(argc, argv);
        flushOutput();
        return code;
    } catch (const std::system_error& error) { // fmt's, which names no stream
        for (const auto& [stream, name] : {std::pair(stdout, "standard output"), std::pair(stderr, "standard error")})
            if (std::ferror(stream) != 0) failToPrint(name, error.code().value());
        throw;
    }
}

/// The last line, in one call and without memory for a short one. Where it cannot be written, the exit code has to do.
void say(std::string_view words) {
    fmt::memory_buffer line;
    fmt::format_to(std::back_inserter(line), "shadowbench: {}\n", words);
    std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    using shadowbench::ExitCode;
    try {
        return static_cast<int>(shadowbench::dispatchAndFlush(argc, argv));
    } catch (const shadowbench::Error& error) {
        const bool isOurs = error.code() == ExitCode::Internal; // a shader's log has lines; words of an input may have any
        shadowbench::say(isOurs ? error.what() : shadowbench::onOneLine(error.what()));
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        shadowbench::say("there is not enough memory; free some, or use --jobs 1 where there is one");
        return static_cast<int>(ExitCode::Internal);
    } catch (const std::exception& error) {
        shadowbench::say(fmt::format("internal error: {}", error.what()));
        return static_cast<int>(ExitCode::Internal);
    }
}
