// operator_mutants: draws mutants of what judges, builds them into one copy of the tree behind a switch, and reports which
// of them the unit tests kill.
#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "base/process.h"
#include "tools/mutants/operators/active.h"
#include "tools/mutants/operators/suite.h"
#include "tools/mutants/operators/syntax.h"
#include "tools/mutants/tool.h"
#include "tools/mutants/tree_copy.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <set>
#include <tuple>

namespace shadowbench::mutants {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
    std::uint64_t seed = 34;
    std::size_t count = 400;
    std::string only = "*";
    double least = 0.95;
    std::filesystem::path folder = std::filesystem::path(SOURCE_FOLDER) / "build/operators";
    std::filesystem::path report;
};

struct Source {
    std::size_t judge = 0;
    std::string file, text;
    std::vector<std::string> flags;
    std::vector<OperatorMutant> mutants; // all that there are
    std::vector<Point> drawn;            // that the compiler takes
};

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void say(const std::string& sentence) {
    fmt::print("{}\n", sentence);
    std::fflush(stdout);
}

std::vector<Source> sourcesOf(const TreeCopy& tree, const std::string& only) {
    const auto isOf = [](const std::string& file, const Judge& judge) {
        return std::ranges::any_of(judge.sources, [&](const std::string& beginning) { return file.starts_with(beginning); });
    };
    std::vector<Source> sources;
    for (std::size_t judge = 0; judge < judges().size(); ++judge)
        for (const std::string& file : tree.files())
            if (file.ends_with(".cpp") && isOf(file, judges()[judge]) && fnmatch(only.c_str(), file.c_str(), 0) == 0)
                sources.push_back({judge, file, tree.read(file), {}, {}, {}});
    return sources;
}

void findMutants(const TreeCopy& tree, std::vector<Source>& sources) {
    tree.build("commit"); // after which it is known how files are compiled
    for (Source& source : sources) source.flags = syntaxFlags(tree.folder() / "build/release", tree.folder() / source.file);
    inParallel(static_cast<int>(sources.size()), availableThreads(), [&](int i) {
        Source& source = sources[static_cast<std::size_t>(i)];
        source.mutants = mutantsOf(source.judge, source.file, source.text, pointsOf(source.text, source.flags));
    });
}

/// Leaves of the drawn points those with which the source compiles; returns whether it had to leave one out.
bool leaveOutWhatDoesNotCompile(Source& source) {
    const Switched planted = switched(source.text, source.drawn);
    std::set<int> refused;
    for (const std::size_t offset : errorsOf(planted.text, source.flags)) // libclang has errors of its own with some headers
        if (const auto number = planted.around(offset)) refused.insert(*number);
    std::erase_if(source.drawn, [&](const Point& point) { return refused.contains(point.number); });
    return !refused.empty();
}

/// The first `count` in the seed's order that compile, numbered, and in their sources.
std::vector<OperatorMutant> draw(std::vector<Source>& sources, const Options& options) {
    std::vector<OperatorMutant> all;
    for (const Source& source : sources) all.insert(all.end(), source.mutants.begin(), source.mutants.end());
    say(fmt::format("{} mutants could be drawn", all.size()));
    shuffle(all, options.seed);
    std::vector<OperatorMutant> drawn;
    for (auto next = all.begin(); next != all.end() && drawn.size() < options.count;) {
        std::set<std::size_t> touched;
        for (; next != all.end() && drawn.size() < options.count; ++next) {
            next->point.number = static_cast<int>(next - all.begin()) + 1;
            const auto source = std::ranges::find(sources, next->file, &Source::file);
            source->drawn.push_back(next->point);
            touched.insert(static_cast<std::size_t>(source - sources.begin()));
            drawn.push_back(*next);
        }
        const std::vector<std::size_t> list(touched.begin(), touched.end());
        inParallel(static_cast<int>(list.size()), availableThreads(), [&](int i) {
            while (leaveOutWhatDoesNotCompile(sources[list[static_cast<std::size_t>(i)]])) {
            }
        });
        std::erase_if(drawn, [&](const OperatorMutant& m) {
            const auto source = std::ranges::find(sources, m.file, &Source::file);
            return std::ranges::find(source->drawn, m.point.number, &Point::number) == source->drawn.end();
        });
    }
    if (!drawn.empty() && drawn.back().point.number >= ::mutants::most) throw InternalError("more mutants than marks");
    return drawn;
}

/// The compiler warns of what mutants do, and warnings are errors. A container of the library that is read beside its end
/// says so, as where tools/sanitize runs the same tests.
void plant(const TreeCopy& tree, const std::vector<Source>& sources) {
    std::string quiet;
    for (const Source& source : sources) {
        if (source.drawn.empty()) continue;
        tree.write(source.file, switched(source.text, source.drawn).text);
        quiet += " " + source.file;
    }
    tree.write("CMakeLists.txt",
               fmt::format("{}set_source_files_properties({} PROPERTIES COMPILE_OPTIONS \"-w;-O1;-D_GLIBCXX_ASSERTIONS\"\n"
                           "  SKIP_PRECOMPILE_HEADERS ON)\n",
                           tree.read("CMakeLists.txt"), quiet));
}

/// Every test of a program, as --gtest_filter names it.
std::vector<std::string> testsOf(const std::filesystem::path& program) {
    std::vector<std::string> tests;
    std::string suite;
    for (std::string line : runTool(program, {"--gtest_list_tests"}, program.parent_path())) {
        line.resize(std::min(line.find(" #"), line.size()));
        if (line.starts_with("  "))
            tests.push_back(suite + line.substr(2));
        else if (line.ends_with('.'))
            suite = line;
    }
    return tests;
}

class Tests {
public:
    Tests(const TreeCopy& tree, std::filesystem::path folder) : tree_(tree), folder_(std::move(folder)) {}

    /// Runs every test of the programs that `mutants` need without any of them on, each alone, which tells what it reaches.
    /// Throws InternalError where one fails.
    void runPlainly(const std::vector<OperatorMutant>& mutants) {
        std::set<std::string> programs;
        for (const OperatorMutant& mutant : mutants)
            programs.insert(judges()[mutant.judge].programs.begin(), judges()[mutant.judge].programs.end());
        for (const std::string& program : programs)
            for (const std::string& test : testsOf(pathOf(program))) tests_.push_back({program, test, {}, {}});
        inParallel(static_cast<int>(tests_.size()), availableThreads(), [&](int i) {
            Test& test = tests_[static_cast<std::size_t>(i)];
            const std::filesystem::path marks = folder_ / fmt::format("{}.reached", i);
            writeFile(marks, std::string(::mutants::most, '\0'));
            const auto start = Clock::now();
            if (!passes(test.program, test.name, {"MUTANTS_REACHED=" + marks.string()}, std::chrono::minutes(10)))
                throw InternalError(fmt::format("{} of {} fails without a mutant", test.name, test.program));
            test.time = std::chrono::milliseconds(static_cast<int>(1000 * secondsSince(start)));
            test.reached = readFile(marks);
            std::filesystem::remove(marks);
        });
    }

    /// With the tests that reach the mutant, those that take least first.
    void runWith(OperatorMutant& mutant) const {
        const auto number = static_cast<std::size_t>(mutant.point.number);
        std::vector<const Test*> reaching;
        for (const Test& test : tests_)
            if (test.reached[number] != 0 &&
                std::ranges::find(judges()[mutant.judge].programs, test.program) != judges()[mutant.judge].programs.end())
                reaching.push_back(&test);
        std::ranges::sort(reaching, {}, [](const Test* test) { return std::tie(test->program, test->time); });
        for (auto next = reaching.begin(); next != reaching.end();) { // a program has many tests that take no time
            std::string names;
            std::chrono::milliseconds time{0};
            const std::string& program = (*next)->program;
            for (; next != reaching.end() && (*next)->program == program && time < std::chrono::seconds(1); ++next) {
                names += (names.empty() ? "" : ":") + (*next)->name;
                time += (*next)->time;
            }
            mutant.end = End::Survives;
            if (passes(program, names, {fmt::format("MUTANT={}", number)}, 3 * time + std::chrono::seconds(10))) continue;
            mutant.end = End::Killed;
            return;
        }
    }

private:
    struct Test {
        std::string program, name;
        std::chrono::milliseconds time;
        std::string reached; // a byte for each mutant
    };

    [[nodiscard]] std::filesystem::path pathOf(const std::string& program) const {
        return tree_.folder() / "build/release/tests" / program;
    }

    [[nodiscard]] bool passes(const std::string& program, const std::string& filter,
                              const std::vector<std::string>& variables, std::chrono::milliseconds limit) const {
        Command command;
        command.program = pathOf(program);
        command.arguments = {"--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + filter};
        command.folder = command.program.parent_path();
        command.limit = limit;
        command.cpuLimit.reset(); // with one, tests of paired times have too coarse a clock
        command.memoryLimit = std::uintmax_t{16} << 30;
        command.fileLimit = std::uintmax_t{1} << 30;
        command.openFiles = {};
        command.environment = ownEnvironment();
        command.environment->insert(command.environment->end(), variables.begin(), variables.end());
        const Finished finished = runProcess(command, [](std::string_view) {});
        return finished.exitCode == 0 && finished.signal == 0 && !finished.timedOut;
    }

    const TreeCopy& tree_;
    std::filesystem::path folder_;
    std::vector<Test> tests_;
};

ExitCode run(const Options& options) {
    const auto start = Clock::now();
    const std::filesystem::path folder = std::filesystem::absolute(options.folder), list = "tools/mutants/operators";
    const auto why = readSurvivors(SOURCE_FOLDER / list / "survivors.toml");
    const TreeCopy tree(SOURCE_FOLDER, folder / "tree");
    std::vector<Source> sources = sourcesOf(tree, options.only);
    findMutants(tree, sources);
    std::vector<OperatorMutant> mutants = draw(sources, options);
    plant(tree, sources);
    say(fmt::format("{:5.0f} s  {} are drawn", secondsSince(start), mutants.size()));
    std::set<std::string> programs;
    for (const OperatorMutant& mutant : mutants)
        programs.insert(judges()[mutant.judge].programs.begin(), judges()[mutant.judge].programs.end());
    for (const std::string& program : programs) tree.build(program);
    say(fmt::format("{:5.0f} s  they are built", secondsSince(start)));

    Tests tests(tree, folder);
    tests.runPlainly(mutants);
    say(fmt::format("{:5.0f} s  the tests pass without a mutant", secondsSince(start)));
    inParallel(static_cast<int>(mutants.size()), availableThreads(), [&](int i) {
        OperatorMutant& mutant = mutants[static_cast<std::size_t>(i)];
        tests.runWith(mutant);
        if (mutant.end != End::Killed)
            say(fmt::format("{} {} {}:{} {} ({}): {} -> {}", mutant.id,
                            mutant.end == End::Survives ? "survives" : "unreached", mutant.file, mutant.line,
                            mutant.point.operation, mutant.point.number, mutant.before, mutant.point.after));
    });
    say(fmt::format("{:5.0f} s  {:.1f} % of {} are killed", secondsSince(start), 100 * killedShare(mutants),
                    mutants.size()));
    if (!options.report.empty()) {
        const std::string commit = runTool("git", {"rev-parse", "--short=12", "HEAD"}, SOURCE_FOLDER).front();
        writeFile(options.report, operatorsReport(mutants, why, fmt::format("commit {}, seed {}", commit, options.seed)));
    }
    return killedShare(mutants) < options.least ? ExitCode::AccuracyRegression : ExitCode::Pass;
}

} // namespace
} // namespace shadowbench::mutants

int main(int argc, char** argv) {
    shadowbench::mutants::Options options;
    CLI::App app("Draws mutants of what judges by operators, builds them into one copy of the tree behind a switch, and "
                 "reports which of them unit tests kill. Exits with 4 when too few are.",
                 "operator_mutants");
    app.add_option("--seed", options.seed, "Which mutants are drawn")->capture_default_str();
    app.add_option("--count", options.count, "How many")->capture_default_str();
    app.add_option("--only", options.only, "Glob over the files that they are of")->capture_default_str();
    app.add_option("--least", options.least, "Share that has to be killed")->capture_default_str();
    app.add_option("--folder", options.folder, "Folder of the copy and its build")->capture_default_str();
    app.add_option("--report", options.report, "Where the report goes (default: nowhere)");
    CLI11_PARSE(app, argc, argv);
    try {
        return static_cast<int>(shadowbench::mutants::run(options));
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "operator_mutants: {}\n", error.what());
        return static_cast<int>(error.code());
    }
}
