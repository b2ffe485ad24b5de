#include "harness/foreign/expected_failures.h"
#include "harness/foreign/renderer.h"
#include "harness/foreign/timing_file.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

namespace shadowbench::fuzz {

void readRendererList(std::string_view input) {
    foreign::readExpectedFailures(kept("renderers.toml", input));
    for (const foreign::Renderer& renderer : foreign::readRenderers(kept("renderers.toml", input)))
        for (const std::string& word : renderer.command)
            foreign::filledIn(word, {{"scene", "/a folder's"}, {"frames", "59,60"}, {"out", "$HOME"}}, renderer.isShellLine);
}

void readTimingFile(std::string_view input) {
    const auto cost = foreign::reportedCost(kept("timing.json", input));
    require(cost && cost->milliseconds > 0, "a time is not above 0");
}

} // namespace shadowbench::fuzz
