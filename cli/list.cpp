#include "base/limits.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/records/comparability.h"
#include "report/listing.h"
#include "studies/behaviour/behaviour.h"
#include "studies/behaviour/technique_page.h"

#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/folder/keys.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

struct ListOptions {
    std::string what = "techniques";
    std::string format = "text";
    bool standard = false;
    bool table = false;
    std::vector<std::string> folderRows; // not used: a folder is listed with the others
    std::filesystem::path pages;         // empty: none are written
    std::vector<std::filesystem::path> records;
};

/// One id a line. Scenes are not loaded for it: shells ask for it while a person types.
std::string idsOf(const std::string& what, bool standard) {
    std::vector<std::string> all;
    if (what == "techniques")
        for (const techniques::Entry& entry : techniques::catalog()) all.push_back(entry.id);
    if (what == "scenes") all = standard ? standardScenes() : builtinScenes();
    if (what == "metrics")
        for (const auto& metric : nlohmann::json::parse(catalogue(what, "json"))) all.push_back(metric.at("id"));
    if (what == "limits")
        for (const LimitEntry& limit : limits()) all.emplace_back(limit.variable);
    return fmt::format("{}\n", fmt::join(all, "\n"));
}

/// Where the published records are, in a clone.
std::vector<std::filesystem::path> publishedRecords() {
    std::vector<std::filesystem::path> files;
    for (const char* set : {"published", "failures"})
        if (const auto file = std::filesystem::path("results") / set / "results.jsonl"; std::filesystem::exists(file))
            files.push_back(file);
    return files;
}

std::vector<Record> recordsOf(const ListOptions& options) {
    return gate::readOfOneDevice(options.records.empty() ? publishedRecords() : options.records);
}

std::string tableOfBehaviours(const ListOptions& options) {
    if (options.what != "techniques") throw BadInput("--table is of techniques: list techniques --table");
    if (options.format == "json" || options.format == "ids") throw BadInput("--table is printed as md or latex");
    return behaviourTable(behaviours(), recordsOf(options), options.format == "latex" ? Markup::Latex : Markup::Markdown);
}

std::string writtenPages(const ListOptions& options) {
    if (options.what != "techniques") throw BadInput("--pages are of techniques: list techniques --pages FOLDER");
    if (options.format != "text") throw BadInput("--pages are Markdown; leave --format out");
    writeTechniquePages(recordsOf(options), options.pages);
    return fmt::format("{} pages: {}\n", techniques::catalog().size(), options.pages.string());
}

std::string listing(const ListOptions& options) {
    if (!options.pages.empty()) return writtenPages(options);
    if (options.table) return tableOfBehaviours(options);
    if (options.format == "latex" || !options.records.empty())
        throw BadInput("--format latex belongs to list techniques --table, --records to that or to --pages");
    if (options.standard && (options.what != "scenes" || options.format != "ids"))
        throw BadInput("--standard chooses among scenes: list scenes --standard --format ids");
    if (options.what == "technique-schema") return techniques::folderSchema();
    return options.format == "ids" ? idsOf(options.what, options.standard) : catalogue(options.what, options.format);
}

} // namespace

void addList(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ListOptions>();
    CLI::App* verb = app.add_subcommand(
        "list", "Lists techniques with their parameters, scenes, metrics or limits, or prints the JSON Schema of records");
    verb->footer(
        "Examples:\n  shadowbench list techniques --format md\n"
        "  shadowbench list techniques --table                    what each is good at, where it fails, which test "
        "says so\n"
        "  shadowbench list techniques --table --format latex --records results/published/results.jsonl\n"
        "  shadowbench list techniques --pages docs/techniques    a page of each, from the published records\n"
        "  shadowbench list limits                                how much files may ask for, and what protects from them");
    verb->add_option("what", options->what,
                     "techniques, scenes, metrics, limits, schema (of records) or technique-schema (of technique.toml)")
        ->check(CLI::IsMember({"techniques", "scenes", "metrics", "limits", "schema", "technique-schema"}));
    verb->add_option("--format", options->format, "text, md or json; ids: one a line; latex: of --table")
        ->check(CLI::IsMember({"text", "md", "json", "ids", "latex"}))
        ->capture_default_str();
    verb->add_flag("--standard", options->standard, "With `scenes --format ids`: only those that a run takes by default");
    addTechniqueFolderOption(*verb);
    CLI::Option* table = verb->add_flag(
        "--table", options->table,
        "Of techniques: source, strength and failure, each with the test that asserts it and a figure, as md or latex");
    verb->add_option("--pages", options->pages,
                     "Of techniques: writes a page of each into this folder, with the scenes of the records on which it is "
                     "good and on which it breaks")
        ->excludes(table);
    verb->add_option("--records", options->records,
                     "Record files that the figures are read from (default: those of results/published and "
                     "results/failures)");
    verb->callback([&action, options] {
        action = [options] {
            fmt::print("{}", listing(*options));
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
