#include "harness/measure/callgrind.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace shadowbench::timing {
namespace {

constexpr std::chrono::minutes longestJob{30};                    // some hundred times what a cell takes uncounted
constexpr std::uintmax_t addressSpace = std::uintmax_t{64} << 30; // Valgrind reserves far more than it uses
constexpr const char* variantsFile = "variants"; // not on the command line, whose length would move the counts
constexpr std::string_view counted = "counted "; // how the worker reports a variant; see renderCountedFrames

std::filesystem::path valgrind() {
    if (const auto program = findProgram("valgrind")) return *program;
    throw Inconclusive("counting instructions needs Valgrind, which is not installed; install it with: apt-get install "
                       "valgrind");
}

std::string ownProgram() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

std::vector<std::string> arguments(const CountJob& job) {
    return {"--tool=callgrind",
            "--instr-atstart=no", // full speed but for the frames that count
            "--collect-atstart=no",
            "--dump-instr=no",
            "--callgrind-out-file=counts.%p", // a process a variant
            ownProgram(),
            "count-frames",
            "--scene",
            job.scene,
            "--profile",
            std::string(name(job.profile)),
            "--seed",
            std::to_string(job.seed),
            "--techniques",
            variantsFile};
}

std::string_view lineAfter(std::string_view text, std::string_view prefix) {
    const std::size_t at = text.find(prefix);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = text.substr(at + prefix.size());
    return rest.substr(0, rest.find('\n'));
}

} // namespace

std::string valgrindVersion() {
    const TemporaryFolder folder;
    std::string version;
    runProcess({valgrind(), {"--version"}, folder.path()}, [&](std::string_view line) { version = line; });
    return version;
}

CallgrindDump parseCallgrindDump(std::string_view text) {
    CallgrindDump dump;
    dump.trigger = lineAfter(text, "desc: Trigger: Client Request: ");
    const std::string_view totals = lineAfter(text, "\ntotals: ");
    const auto [end, error] = std::from_chars(totals.data(), totals.data() + totals.size(), dump.instructions);
    if (dump.trigger.empty() || error != std::errc() || end != totals.data() + totals.size())
        throw BadInput("a file of instruction counts has no trigger or no total: it was not written by Callgrind's client "
                       "requests");
    return dump;
}

Counts countInstructions(const CountJob& job, const std::function<void(std::string_view)>& onVariant) {
    const TemporaryFolder folder;
    writeFile(folder.path() / variantsFile, fmt::format("{}\n", fmt::join(job.variants, "\n")));
    Command command{valgrind(), arguments(job), folder.path()};
    command.limit = longestJob;
    command.cpuLimit = longestJob;
    command.memoryLimit = addressSpace;
    command.inherited = techniques::inheritedVariables();
    std::string last;
    const Finished finished = runProcess(command, [&](std::string_view line) {
        last = line;
        if (line.starts_with(counted)) onVariant(line.substr(counted.size()));
    });
    if (finished.timedOut || finished.signal != 0 || finished.exitCode != 0)
        throw Inconclusive(fmt::format("counting instructions on scene {} {}: {}", job.scene,
                                       finished.timedOut ? "took more than 30 minutes" : "failed under Valgrind", last),
                           finished.signal != 0 ? Failure::Transient : Failure::Lasting);
    Counts counts;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string file = entry.path().filename().string();
        // "counts.<process>.<dump>"; what comes after the dump, in "counts.<process>", does not count.
        if (!file.starts_with("counts.") || std::ranges::count(file, '.') != 2) continue;
        const CallgrindDump dump = parseCallgrindDump(readFile(entry.path()));
        counts[dump.trigger] = dump.instructions;
    }
    return counts;
}

} // namespace shadowbench::timing
