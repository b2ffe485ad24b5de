// How long `develop` takes from the save of a shader to its picture in a browser, and whether it grows with saves.
//     build/release/tests/live_saves --saves 100 --more 900
#include "tests/browser/browser.h"
#include "tests/support/live_page.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

/// Milliseconds since 1970, as Date.now() has them.
double now() {
    return std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// The answer is another one with each number.
std::string shader(int number) {
    return replaced(mapShader, "testedPoint(receiver))",
                    fmt::format("testedPoint(receiver)) * {:.3f}", 0.5 + 0.0005 * number));
}

/// From before the file is written to the frame of the page in which the picture of it is there.
double millisecondsOf(browser::Tab& tab, const WrittenTechnique& folder, int number) {
    tab.value("window.before = document.querySelector('img').src");
    const double begin = now();
    folder.write("resolve.frag", shader(number));
    const double end =
        tab.value("new Promise((done) => { const look = () => { const img = document.querySelector('img');"
                  " if (img && img.src !== window.before && img.complete && img.naturalWidth > 0) done(Date.now());"
                  " else requestAnimationFrame(look); }; look(); })")
            .get<double>();
    return end - begin;
}

double residentMib(pid_t process) {
    std::ifstream status(fmt::format("/proc/{}/status", process));
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
    throw std::runtime_error("develop has ended");
}

double quantile(std::vector<double> sorted, double share) {
    std::ranges::sort(sorted);
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

void measure(int saves, int more) {
    const WrittenTechnique folder(mapToml, shader(0));
    const TemporaryFolder room;
    const LivePage page(folder.path(), room.path(), {}, "simple");
    browser::Browser chromium;
    const auto tab = chromium.tab();
    tab->visit(page.address() + "/");
    tab->waitFor("document.querySelector('img')?.naturalWidth > 0");
    std::vector<double> times;
    for (int number = 1; number <= saves; ++number) times.push_back(millisecondsOf(*tab, folder, number));
    fmt::print("{} saves of a shader on the scene simple, 256²: median {:.0f} ms, p95 {:.0f} ms, longest {:.0f} ms\n", saves,
               quantile(times, 0.5), quantile(times, 0.95), quantile(times, 1));
    fmt::print("develop's resident memory: {:.1f} MiB after {} saves\n", residentMib(page.process()), saves);
    for (int number = saves + 1; number <= saves + more; ++number) {
        millisecondsOf(*tab, folder, number);
        if (number % 100 == 0) fmt::print("{:.1f} MiB after {}\n", residentMib(page.process()), number);
    }
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    CLI::App app("Saves of a technique folder that develop shows in a browser.");
    int saves = 100, more = 0;
    app.add_option("--saves", saves, "How many are timed")->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_option("--more", more, "How many follow, for memory alone")->check(CLI::Range(0, 10'000))->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    shadowbench::measure(saves, more);
}
