#include "cli/command.h"
#include "techniques/folder/templates.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace shadowbench {
namespace {

struct NewTechniqueWords {
    std::string id, like = "shadow-map";
    std::filesystem::path folder;
};

ExitCode writeAndPrint(const NewTechniqueWords& words) {
    const std::filesystem::path folder = words.folder.empty() ? std::filesystem::path(words.id) : words.folder;
    for (const std::filesystem::path& file : techniques::writeFromTemplate(words.like, words.id, folder))
        fmt::print("written: {}\n", file.string());
    fmt::print("see it: shadowbench develop {}\n", folder.string());
    return ExitCode::Pass;
}

} // namespace

void addNewTechnique(CLI::App& app, Action& action) {
    const auto words = std::make_shared<NewTechniqueWords>();
    CLI::App* verb = app.add_subcommand("new-technique", "Writes a technique folder to begin with, which runs as it is");
    verb->footer("Examples:\n  shadowbench new-technique evsm --like vsm\n"
                 "  shadowbench new-technique my-filter --like pcf --folder techniques/my-filter");
    verb->add_option("id", words->id, "Id of the technique; its rows are my:ID")->required();
    verb->add_option("--like", words->like,
                     fmt::format("What it begins as: {}", fmt::join(techniques::folderTemplates(), ", ")))
        ->capture_default_str();
    verb->add_option("--folder", words->folder, "Folder that is made (default: ID, here)");
    verb->callback([&action, words] { action = [words] { return writeAndPrint(*words); }; });
}

} // namespace shadowbench
