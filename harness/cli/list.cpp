#include "harness/cli/command.h"
#include "harness/report/listing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct ListOptions {
    std::string what = "techniques";
    std::string format = "text";
};

} // namespace

void addList(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ListOptions>();
    CLI::App* verb = app.add_subcommand("list", "Lists techniques with their parameters, scenes or metrics");
    verb->footer("Example:\n  shadowbench list techniques --format md");
    verb->add_option("what", options->what, "techniques, scenes or metrics")
        ->check(CLI::IsMember({"techniques", "scenes", "metrics"}));
    verb->add_option("--format", options->format, "text, md or json")
        ->check(CLI::IsMember({"text", "md", "json"}))
        ->capture_default_str();
    verb->callback([&action, options] {
        action = [options] {
            fmt::print("{}", catalogue(options->what, options->format));
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
