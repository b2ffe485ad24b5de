#include "studies/gpu_cost/gpu_cost.h"

#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace shadowbench {
namespace {

struct VerbOptions {
    gpucost::GpuCostOptions study;
    std::vector<std::filesystem::path> records; // files, or folders that runs wrote them to
    std::vector<std::string> sizes{"1920x1080"};
    std::filesystem::path out = "results/latest/gpu-cost";
};

/// "1920x1080", each side from 1 to 16384.
glm::ivec2 sizeNamed(const std::string& text) {
    glm::ivec2 size{};
    const char* const end = text.data() + text.size();
    const auto [cross, first] = std::from_chars(text.data(), end, size.x);
    const bool isCross = first == std::errc() && cross != end && *cross == 'x';
    const auto [rest, second] = isCross ? std::from_chars(cross + 1, end, size.y) : std::from_chars(end, end, size.y);
    if (second != std::errc() || rest != end || std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > 16384)
        throw BadInput(fmt::format("--size {} is no size of an image; write it as 1920x1080, at most 16384 a side", text));
    return size;
}

ExitCode printGpuCosts(const VerbOptions& options) {
    gpucost::GpuCostOptions study = options.study;
    study.sizes.clear();
    for (const std::string& size : options.sizes) study.sizes.push_back(sizeNamed(size));
    std::vector<Record> records;
    for (const std::filesystem::path& place : options.records)
        std::ranges::move(recordsAt(place), std::back_inserter(records));
    const OutputLock alone(options.out);
    const gpucost::GpuCostResult result = gpucost::gpuCosts(records, study);
    for (const std::string& error : result.errors) fmt::print(stderr, "shadowbench: {}\n", error);
    for (const std::string& reason : result.leftOut) fmt::print(stderr, "{}\n", reason);
    if (result.frames.empty()) return result.code == ExitCode::Pass ? ExitCode::BadInput : result.code;
    const std::filesystem::path file = options.out / "results.jsonl";
    gpucost::addTo(records, result.frames);
    writeRecords(file, records);
    fmt::print("{}{}records: {}\n", gpucost::tables(result.frames), gpucost::comparison(result.frames), file.string());
    return result.code;
}

} // namespace

void addGpuCost(CLI::App& app, Action& action) {
    const auto options = std::make_shared<VerbOptions>();
    gpucost::GpuCostOptions& study = options->study;
    CLI::App* verb = app.add_subcommand(
        "gpu-cost", "Models milliseconds of frames on named graphics cards, from records and from the code of shaders");
    verb->footer(
        "Times are modelled and not measured (docs/gpu-cost.md). Records that were measured on one of the cards are\n"
        "modelled in the sizes that were measured, too, and both are compared.\n"
        "Examples:\n  shadowbench gpu-cost results/latest --card gtx-1080 --size 3840x2160\n"
        "  shadowbench gpu-cost results/latest --card gtx-1080 --size 1920x1080 --size 3840x2160 --out results/latest\n"
        "  shadowbench gpu-cost results/gpu --card h200");
    verb->add_option("RECORDS", options->records, "Files of records, or folders with results.jsonl, of the profile `gate`")
        ->required();
    verb->add_option("--card", study.cards, "Card; repeatable (default: all)")
        ->type_name("TEXT:{geforce-7600-gt,gtx-1080,h200,rtx-2080-ti,rx-6800-xt}");
    verb->add_option("--size", options->sizes, "Image in pixels; repeatable")->capture_default_str();
    verb->add_option("--out", options->out,
                     "Folder of results.jsonl: the records with every term of every pass; may be that of RECORDS")
        ->capture_default_str();
    verb->add_option("--cache", study.cache,
                     "Folder of references, which keeps figures, too (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addGlOption(*verb);
    verb->add_flag("--quiet", study.quiet, "No progress");
    verb->callback([&action, options] { action = [options] { return printGpuCosts(*options); }; });
}

} // namespace shadowbench
