// Not for people: writes the manual page and the completion scripts that are installed.
#include "cli/documents.h"

#include "base/files.h"
#include "harness/cells/environment.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

namespace shadowbench {

void addDocuments(CLI::App& app, Action& action) {
    const auto folder = std::make_shared<std::filesystem::path>();
    CLI::App* verb = app.add_subcommand("documents", "Writes the manual page and the shell completion into a folder");
    verb->group(""); // left out of --help
    verb->add_option("folder", *folder)->required();
    verb->callback([&app, &action, folder] {
        action = [&app, folder] {
            writeFile(*folder / "shadowbench.1", manualPage(app, programVersion()));
            writeFile(*folder / "shadowbench.bash", bashCompletion(app));
            writeFile(*folder / "_shadowbench", zshCompletion(app));
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
