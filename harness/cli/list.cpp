#include "harness/cli/command.h"
#include "harness/report/listing.h"

#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <CLI/CLI.hpp>
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
};

/// One id a line. Scenes are not loaded for it: shells ask for it while a person types.
std::string idsOf(const std::string& what, bool standard) {
    std::vector<std::string> all;
    if (what == "techniques")
        for (const techniques::Entry& entry : techniques::catalog()) all.push_back(entry.id);
    if (what == "scenes") all = standard ? standardScenes() : builtinScenes();
    if (what == "metrics")
        for (const auto& metric : nlohmann::json::parse(catalogue(what, "json"))) all.push_back(metric.at("name"));
    return fmt::format("{}\n", fmt::join(all, "\n"));
}

std::string listing(const ListOptions& options) {
    if (options.standard && (options.what != "scenes" || options.format != "ids"))
        throw BadInput("--standard chooses among scenes: list scenes --standard --format ids");
    return options.format == "ids" ? idsOf(options.what, options.standard) : catalogue(options.what, options.format);
}

} // namespace

void addList(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ListOptions>();
    CLI::App* verb = app.add_subcommand(
        "list", "Lists techniques with their parameters, scenes or metrics, or prints the JSON Schema of records");
    verb->footer("Example:\n  shadowbench list techniques --format md");
    verb->add_option("what", options->what, "techniques, scenes, metrics or schema")
        ->check(CLI::IsMember({"techniques", "scenes", "metrics", "schema"}));
    verb->add_option("--format", options->format, "text, md or json; ids: one a line")
        ->check(CLI::IsMember({"text", "md", "json", "ids"}))
        ->capture_default_str();
    verb->add_flag("--standard", options->standard, "With `scenes --format ids`: only those that a run takes by default");
    verb->callback([&action, options] {
        action = [options] {
            fmt::print("{}", listing(*options));
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
