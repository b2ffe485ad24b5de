#include "harness/foreign/call_renderer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/foreign/timing_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t mostOutput = 16 << 20;                  // bytes; a verbose renderer says some MiB
constexpr std::uintmax_t largestFile = std::uintmax_t{16} << 30; // bytes, of one file that it writes
constexpr std::size_t longestQuote = 200;                        // characters of what it said

/// What can stand in one line of ours.
std::string printable(std::string_view line) {
    std::string text;
    for (const unsigned char c : line.substr(0, longestQuote)) text += c < 0x20 || c == 0x7f ? ' ' : static_cast<char>(c);
    return line.size() > longestQuote ? text + " …" : text;
}

[[noreturn]] void fail(const std::string& what, const std::string& said) {
    throw Inconclusive(fmt::format("its command {}{}{}", what, said.empty() ? "" : "; it last said: ", printable(said)));
}

void requireSuccess(const Renderer& renderer, const Finished& finished, const std::string& said) {
    const double limit = std::chrono::duration<double>(renderer.limit).count();
    if (finished.timedOut) fail(fmt::format("did not end within its time_limit of {:g} s and was killed", limit), said);
    if (finished.flooded)
        fail(fmt::format("wrote more than {} MiB to its standard output and was killed", mostOutput >> 20U), said);
    if (finished.signal != 0)
        fail(fmt::format("was ended by signal {} ({})", finished.signal, strsignal(finished.signal)), said);
    if (finished.exitCode != 0) fail(fmt::format("ended with exit code {}", finished.exitCode), said);
}

/// The file `stem`.exr, .png or .pfm; nothing if there is none. Throws Inconclusive for several.
std::optional<fs::path> imageIn(const fs::path& out, const std::string& stem) {
    std::optional<fs::path> found;
    for (const char* ending : {".exr", ".png", ".pfm"}) {
        const fs::path file = out / (stem + ending);
        if (!fs::exists(file)) continue;
        if (found)
            fail(fmt::format("wrote both {} and {}: which one is meant?", found->filename().string(),
                             file.filename().string()),
                 "");
        found = file;
    }
    return found;
}

/// What else lies there, for an error message.
std::string others(const fs::path& out) {
    if (!fs::is_directory(out)) return "the folder is gone";
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(out)) names.push_back(entry.path().filename().string());
    if (names.empty()) return "the folder is empty";
    std::ranges::sort(names);
    const std::size_t all = names.size();
    names.resize(std::min<std::size_t>(all, 6));
    return printable(fmt::format("the folder holds {}{}", fmt::join(names, ", "), all > names.size() ? " …" : ""));
}

std::vector<std::string> environmentOf(const Renderer& renderer, std::vector<std::string> variables,
                                       const fs::path& scratch) {
    // Where truths are kept is none of its business.
    std::erase_if(variables, [](const std::string& v) { return v.starts_with("SHADOWBENCH_CACHE"); });
    std::vector<std::pair<std::string, std::string>> own = renderer.environment;
    own.emplace_back("TMPDIR", scratch.string()); // what it leaves there is removed
    for (const auto& [name, value] : own) {
        std::erase_if(variables, [&](const std::string& v) { return v.starts_with(name + "="); });
        variables.push_back(name + "=" + value);
    }
    return variables;
}

} // namespace

fs::path programOf(const Renderer& renderer) {
    const fs::path name = renderer.command.front();
    if (const auto found = findProgram(name.has_parent_path() ? renderer.folder / name : name)) return *found;
    throw Inconclusive(fmt::format("its program {} is not there, or may not be run; install it, or correct `command` of {}",
                                   name.string(), renderer.id));
}

Rendered foundIn(const fs::path& out, const std::vector<int>& frames) {
    Rendered rendered;
    std::vector<int> missing;
    for (const int frame : frames) {
        const std::string stem = fmt::format("frame-{}", frame);
        const std::optional<fs::path> image = imageIn(out, stem);
        if (!image) missing.push_back(frame);
        rendered.frames.push_back({.frame = frame,
                                   .image = image.value_or(""),
                                   .lit = imageIn(out, stem + "-lit"),
                                   .unlit = imageIn(out, stem + "-unlit"),
                                   .hits = imageIn(out, stem + "-hits"),
                                   .depth = imageIn(out, stem + "-depth")});
    }
    if (!missing.empty())
        fail(fmt::format("wrote no image of frame{} {} (frame-{}.exr, .png or .pfm in {{out}}): {}",
                         missing.size() > 1 ? "s" : "", fmt::join(missing, ", "), missing.front(), others(out)),
             "");
    rendered.reported = reportedCost(out / "timing.json");
    return rendered;
}

Rendered callRenderer(const Renderer& renderer, const fs::path& scene, const std::vector<int>& frames, const fs::path& out,
                      std::vector<std::string> variables, const OnLine& onLine) {
    const TemporaryFolder scratch;
    Command command{programOf(renderer), {}, renderer.folder};
    for (std::size_t i = 1; i < renderer.command.size(); ++i)
        command.arguments.push_back(filledIn(
            renderer.command[i],
            {{"scene", scene.string()}, {"frames", fmt::format("{}", fmt::join(frames, ","))}, {"out", out.string()}},
            renderer.isShellLine));
    command.limit = renderer.limit;
    command.cpuLimit.reset();
    command.memoryLimit.reset();
    command.openFiles.reset();
    command.fileLimit = largestFile;
    command.environment = environmentOf(renderer, std::move(variables), scratch.path());
    command.outputLimit = mostOutput;
    command.endsStrays = true;
    std::string said;
    const Finished finished = runProcess(command, [&](std::string_view line) {
        said = line;
        if (onLine) onLine(line);
    });
    requireSuccess(renderer, finished, said);
    return foundIn(out, frames);
}

} // namespace shadowbench::foreign
