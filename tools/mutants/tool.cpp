#include "tools/mutants/tool.h"

#include "base/error.h"
#include "base/process.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench::mutants {
namespace {

std::filesystem::path found(const std::filesystem::path& program) {
    const auto file = findProgram(program);
    if (!file) throw Inconclusive(fmt::format("the suite needs {}, which is not there", program.string()));
    return *file;
}

/// Words for `env` that undo what runProcess sets: a compiler's cache lies in the home, and tells by the language what our
/// own builds have filled it with.
std::vector<std::string> withOurLanguageAndHome() {
    std::vector<std::string> words{"-u", "LC_ALL"};
    for (const char* name : {"HOME", "LANG", "LC_ALL"})
        if (const char* value = std::getenv(name)) words.push_back(fmt::format("{}={}", name, value));
    return words;
}

/// The first line that complains, else the last one.
std::string complaint(const std::vector<std::string>& lines) {
    const auto first =
        std::ranges::find_if(lines, [](const std::string& line) { return line.find("rror") != std::string::npos; });
    if (first != lines.end()) return *first;
    return lines.empty() ? "it printed nothing" : lines.back();
}

} // namespace

std::vector<std::string> runTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder) {
    Command command;
    command.program = found("env");
    command.arguments = withOurLanguageAndHome();
    command.arguments.insert(command.arguments.end(), {found("nice").string(), found(program).string()});
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    command.folder = folder;
    command.limit = std::chrono::hours(2);
    command.cpuLimit = std::chrono::hours(2);
    command.fileLimit = std::uintmax_t{1} << 30;
    command.memoryLimit = std::uintmax_t{32} << 30;
    std::vector<std::string> lines;
    const Finished finished = runProcess(command, [&](std::string_view line) { lines.emplace_back(line); });
    if (finished.exitCode == 0 && finished.signal == 0 && !finished.timedOut) return lines;
    throw InternalError(fmt::format("{} failed: {}", program.filename().string(), complaint(lines)));
}

} // namespace shadowbench::mutants
