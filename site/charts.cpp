#include "site/charts.h"
#include "site/made_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/temporary_folder.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <vector>

namespace shadowbench::site {
namespace {

std::string programOf(const char* name, const char* package) {
    const auto program = findProgram(name);
    if (!program)
        throw Inconclusive(fmt::format("drawing charts: {} is not installed; run `apt-get install {}`", name, package));
    return program->string();
}

std::string converted(const std::string& svg, std::vector<std::string> how) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "chart.svg", svg);
    Command command{
        programOf("env", "coreutils"),
        {"SOURCE_DATE_EPOCH=0", programOf("rsvg-convert", "librsvg2-bin"), "--unlimited", "--output=chart", "chart.svg"},
        folder.path()};
    std::ranges::move(how, std::back_inserter(command.arguments));
    std::string messages;
    const Finished end = runProcess(command, [&](std::string_view line) { messages.append(line).append(" "); });
    if (end.timedOut || end.signal != 0 || end.exitCode != 0)
        throw Inconclusive(
            fmt::format("drawing charts: rsvg-convert ended with status {}, signal {} ({}); reinstall librsvg2-bin",
                        end.exitCode, end.signal, messages));
    return readFile(folder.path() / "chart");
}

} // namespace

std::string pdfOf(const std::string& svg) { return converted(svg, {"--format=pdf"}); }

std::string pngOf(const std::string& svg, double pixelsPerUnit) {
    return converted(svg, {"--format=png", fmt::format("--zoom={}", pixelsPerUnit)});
}

void writePdf(const SiteWriter& site, const std::string& name) {
    const std::filesystem::path& folder = site.folder();
    writeMade(folder / (name + ".pdf"), pdfOf(readFile(folder / (name + ".svg"))));
}

void writeChart(const SiteWriter& site, const std::string& name, const std::string& svg) {
    writeMade(site.folder() / (name + ".svg"), svg);
    writePdf(site, name);
}

} // namespace shadowbench::site
