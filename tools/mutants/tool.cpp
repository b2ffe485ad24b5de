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

} // namespace

std::string ToolResult::complaint() const {
    constexpr std::string_view failed = "[  FAILED  ] ";
    for (const std::string_view word : {failed, std::string_view("rror")})
        for (const std::string& line : lines)
            if (const std::size_t at = line.find(word); at != std::string::npos)
                return word == failed ? line.substr(at + failed.size()) : line;
    return lines.empty() ? "it printed nothing" : lines.back();
}

ToolResult tryTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
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
    command.openFiles.reset(); // tests set a limit of their own
    ToolResult result;
    const Finished finished = runProcess(command, [&](std::string_view line) { result.lines.emplace_back(line); });
    result.succeeded = finished.exitCode == 0 && finished.signal == 0 && !finished.timedOut;
    return result;
}

std::vector<std::string> runTool(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const std::filesystem::path& folder) {
    ToolResult result = tryTool(program, arguments, folder);
    if (result.succeeded) return std::move(result.lines);
    throw InternalError(fmt::format("{} failed: {}", program.filename().string(), result.complaint()));
}

} // namespace shadowbench::mutants
