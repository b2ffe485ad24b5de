#include "gate/gate_report.h"

#include "base/one_line.h"
#include "base/shell_word.h"
#include "gate/verdict.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::gate {
namespace {

constexpr std::size_t mostTimes = 5;

/// A list under a heading; nothing when it is empty.
std::string section(const std::string& heading, const std::vector<std::string>& lines) {
    return lines.empty() ? "" : fmt::format("{}:\n  {}\n", heading, fmt::join(lines, "\n  "));
}

/// Another renderer's cell that failed: its author wants to see that again, too.
bool isFailedCall(const Change& change, const GateResult& result) {
    const std::string cell = fmt::format("{} on {}", change.variant, change.scene);
    return change.variant.starts_with(externalPrefix) && change.direction == Direction::NotCompared &&
           std::ranges::find(result.presence.failed, cell) != result.presence.failed.end();
}

std::vector<std::string> commands(const GateResult& result, const GateOptions& options) {
    std::vector<std::string> lines;
    for (const Change& change : worstFirst(result.changes)) {
        if (change.direction != Direction::Worse && !isFailedCall(change, result)) continue;
        const std::string line = reproduction(change, options);
        if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> pictureLines(const GateResult& result) {
    std::vector<std::string> lines;
    for (const FailurePictures& cell : result.pictures) {
        std::string line = fmt::format("{} on {}:", cell.variant, cell.scene);
        for (const std::filesystem::path& folder : {cell.head, cell.base})
            if (!folder.empty()) line += fmt::format(" {}", (folder / "{visibility,reference,error}.png").string());
        lines.push_back(std::move(line));
    }
    return lines;
}

/// The last words of what failed, under what they are of.
std::string logText(const std::vector<FailureLog>& logs) {
    std::string text;
    for (const FailureLog& log : logs)
        text += section(fmt::format("{}; its last lines, of {}", log.what, log.file.string()), log.lines);
    return text;
}

/// The same of the first one as Markdown, in which none of its lines is markup.
std::string logComment(const std::vector<FailureLog>& logs) {
    constexpr std::string_view fence = "````";
    if (logs.empty()) return "";
    const std::string more = logs.size() > 1 ? fmt::format(" ({} more on the page)", logs.size() - 1) : "";
    std::string text = fmt::format("\n{}, in its own words{}:\n{}\n", onOneLine(logs.front().what), more, fence);
    for (std::string line : logs.front().lines) {
        for (std::size_t at = line.find(fence); at != std::string::npos; at = line.find(fence)) line[at] = ' ';
        text += line + "\n";
    }
    return fmt::format("{}{}\n", text, fence);
}

/// The file of a scene that is named by one, else its id.
std::string sceneArgument(const std::string& scene, const GateOptions& options) {
    const auto file = std::ranges::find_if(options.scenes, [&](const std::string& argument) {
        const std::filesystem::path path(argument);
        return path.has_extension() && path.stem() == scene;
    });
    return file == options.scenes.end() ? scene : *file;
}

std::vector<std::string> slowest(std::vector<StepTime> times) {
    std::ranges::sort(times, std::ranges::greater(), &StepTime::seconds);
    times.resize(std::min(times.size(), mostTimes));
    std::vector<std::string> lines;
    for (const StepTime& time : times)
        if (time.seconds >= 1) lines.push_back(fmt::format("{:.0f} s  {}", time.seconds, time.name));
    return lines;
}

} // namespace

std::string reproduction(const Change& change, const GateOptions& options) {
    std::string which =
        fmt::format("--scene {} --technique {} --profile {} --seed {}", shellWord(sceneArgument(change.scene, options)),
                    shellWord(change.variant), name(options.profile), options.seed);
    const bool isOther = change.variant.starts_with(externalPrefix);
    for (const auto& file : options.externalFiles)
        if (isOther) which += " --external " + shellWord(file.string());
    const char* program = isOther ? "shadowbench" : "./bench"; // which is of our own clone
    switch (change.changeClass) {
    case Class::Time:
        return fmt::format("{} gate --base {} --cost time {}", program, shellWord(options.base), which);
    case Class::BreakPoint:
        return fmt::format("{} sweep --axis {} {}", program, change.axis, which);
    case Class::Shader:
        return fmt::format("{} shader-cost --technique {} --base {}", program, shellWord(change.variant),
                           shellWord((shaderFolder(options) / "base/shader-cost.jsonl").string()));
    case Class::Instructions:
        return fmt::format("{} run --cost instructions {}", program, which);
    default:
        return fmt::format("{} run --images --cost none --out results/reproduced {}", program, which);
    }
}

std::string gateReport(const GateResult& result, const GateOptions& options) {
    std::string text = section("looser than the base", result.loosened) + changesReport(result) +
                       section("to see it again", commands(result, options)) + section("pictures", pictureLines(result)) +
                       section("not compared", result.notCompared) + logText(result.logs) + section("to note", result.notes);
    text += section(fmt::format("slowest parts of {:.0f} s, some side by side", result.seconds), slowest(result.times));
    return text + fmt::format("gate: {} (head {}, base {})\n", verdictText(result.code()), result.head, result.base);
}

std::string gateComment(const GateResult& result, const GateOptions& options) {
    const bool failed = !result.logs.empty(); // whose words leave the rest fewer of 40 lines
    const std::size_t mostWorst = failed ? 1 : 10, mostNotCompared = failed ? 2 : 4, mostOthers = failed ? 0 : 3,
                      mostCommands = failed ? 1 : 2;
    std::string text = fmt::format("## shadowbench: {}\n\nHead {}, base {}. {}.\n", verdictText(result.code()), result.head,
                                   result.base, gate::text(result.presence));
    const auto list = [&](std::string_view heading, const std::vector<std::string>& lines, std::size_t most) {
        if (lines.empty() || most == 0) return;
        text += fmt::format("\n{}:\n", heading);
        for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) text += fmt::format("* {}\n", onOneLine(lines[i]));
        if (lines.size() > most) text += fmt::format("* … and {} more\n", lines.size() - most);
    };
    std::vector<std::string> worse, notCompared = result.notCompared, others;
    for (const Change& change : oneACause(worstFirst(result.changes))) {
        std::vector<std::string>& lines = change.direction == Direction::Worse         ? worse
                                          : change.direction == Direction::NotCompared ? notCompared
                                                                                       : others;
        lines.push_back(fmt::format("{}: {}", name(change.direction), change.sentence));
    }
    list("Looser than the base", result.loosened, mostOthers);
    list("Not compared", notCompared, mostNotCompared);
    list("Worse", worse, mostWorst);
    text += logComment(result.logs);
    list("Unclear, waived or better", others, mostOthers);
    std::vector<std::string> again = commands(result, options);
    for (std::string& command : again) command = "`" + command + "`";
    list("To see it again", again, mostCommands);
    return text;
}

} // namespace shadowbench::gate
