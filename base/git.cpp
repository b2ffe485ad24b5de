#include "base/git.h"

#include "base/process.h"

#include <string_view>

namespace shadowbench {

std::optional<std::vector<std::string>> git(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
    const auto program = findProgram("git");
    if (!program) return {};
    std::vector<std::string> lines;
    Command command;
    command.program = *program;
    command.arguments = {"-c", "safe.directory=*"}; // a container's user need not own the clone
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    command.folder = folder;
    const Finished end = runProcess(command, [&](std::string_view line) { lines.emplace_back(line); });
    if (end.timedOut || end.signal != 0 || end.exitCode != 0) return {};
    return lines;
}

std::string firstLine(const std::optional<std::vector<std::string>>& lines) {
    return lines && !lines->empty() ? lines->front() : "";
}

} // namespace shadowbench
