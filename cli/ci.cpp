#include "gate/ci.h"

#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/gate_result.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowbench {
namespace {

ExitCode judgeAndPrint(const gate::CiOptions& options, const GateFiles& files) {
    const OutputLock alone(options.out);
    const gate::CiResult judged = gate::judgeCommits(options);
    return writeGate(judged.result, judged.shown, files, judged.root);
}

} // namespace

void addCi(CLI::App& app, Action& action) {
    const auto options = std::make_shared<gate::CiOptions>();
    const auto files = std::make_shared<GateFiles>();
    CLI::App* verb = app.add_subcommand("ci", "Judges the renderers of your own repository: HEAD against its base");
    verb->footer(
        "Examples:\n  shadowbench ci\n"
        "  shadowbench ci --base HEAD~1 --out shadows\n"
        "  shadowbench ci --summary shadows.md --junit shadows.xml --sarif shadows.sarif --annotations\n"
        "Reads shadowbench.toml at the root of the repository that it is run in (docs/ci.md): which renderers, which "
        "scenes, "
        "what\nbuilds them. Builds and calls those of both commits, each in a work tree of its own, and keeps what they "
        "drew: "
        "a second\nrun calls nobody. Exits with 5 when something could not be judged, such as a renderer that crashed, else "
        "with 4 when\naccuracy or stability is worse, and 0 when nothing is.");
    verb->add_option("--base", options->base,
                     "Commit to judge against (default: where HEAD's branch left its target, as GitHub and GitLab name it, "
                     "else origin/HEAD, origin/main or main)");
    verb->add_option("--config", options->config,
                     "The file of each commit to go by (default: shadowbench.toml at the root)");
    verb->add_option("--out", options->out, "Folder of the page, pictures of failing cells and logs")->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references and of what was drawn (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addGateFiles(*verb, *files);
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, files] { action = [options, files] { return judgeAndPrint(*options, *files); }; });
}

} // namespace shadowbench
