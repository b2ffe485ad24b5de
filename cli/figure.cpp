#include "site/figure/figure.h"

#include "base/temporary_folder.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/cells/cell_selection.h"
#include "harness/runs/run.h"
#include "site/figure/figure_files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct FigureWords {
    std::string scene, profile = "gate";
    std::vector<std::string> techniques, insets;
    std::filesystem::path records, images, cache, out = "figure.pdf";
    bool shaded = false, quiet = false;
};

/// As records name them: variants and globs of the catalogue, and rows of other renderers word by word.
std::vector<std::string> variantsOf(const std::vector<std::string>& words) {
    std::vector<std::string> names;
    for (const std::string& word : words) {
        if (word.starts_with("external:"))
            names.push_back(word);
        else
            for (const techniques::Variant& variant : chosenVariants({word})) names.push_back(variant.name);
    }
    return names;
}

/// The cells, drawn into `folder`.
std::vector<Record> drawn(const FigureWords& words, const std::filesystem::path& folder) {
    RunOptions cells;
    cells.scenes = {words.scene};
    cells.techniques = words.techniques;
    cells.profile = profileNamed(words.profile);
    cells.out = folder;
    cells.cache = words.cache;
    cells.measure.time = false;
    cells.measure.images = folder / "images";
    cells.quiet = words.quiet;
    const RunResult result = run(cells);
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            throw Error(result.code, fmt::format("{} on {}: {}", record.variant, record.scene, record.reason));
    return result.records;
}

ExitCode makeFigure(const FigureWords& words) {
    site::requireFigureFile(words.out);
    site::FigureRequest request{.scene = words.scene, .variants = variantsOf(words.techniques), .shaded = words.shaded};
    for (const std::string& inset : words.insets) request.insets.push_back(site::insetOf(inset));
    const TemporaryFolder folder;
    std::vector<Record> records;
    std::filesystem::path images = words.images;
    if (words.records.empty()) {
        records = drawn(words, folder.path());
        images = folder.path() / "images";
        request.scene = records.front().scene; // of a file its id
    } else {
        records = recordsAt(words.records);
        const bool isFolder = std::filesystem::is_directory(words.records);
        if (images.empty()) images = (isFolder ? words.records : words.records.parent_path()) / "images";
    }
    const site::Figure figure = site::figureOf(request, records, images);
    for (const std::filesystem::path& file : site::writeFigure(figure, words.out)) fmt::print("figure: {}\n", file.string());
    for (const site::Inset& inset : figure.insets) fmt::print("inset: {}\n", site::textOf(inset));
    return ExitCode::Pass;
}

} // namespace

void addFigure(CLI::App& app, Action& action) {
    const auto words = std::make_shared<FigureWords>();
    CLI::App* verb = app.add_subcommand(
        "figure", "A figure for papers and lectures: truth and techniques side by side, enlarged parts, errors");
    verb->footer("A PDF has beside it a .tex with the figure environment, caption and \\label{fig:NAME}.\n"
                 "Examples:\n  shadowbench figure --scene simple --technique pcf --technique pcss --out soft.pdf\n"
                 "  shadowbench figure --scene trees --technique 'sm-lispsm' --technique vsm --shaded --inset 96,128,40,40 "
                 "--inset 10,120,40,40 --out trees.png\n"
                 "  shadowbench figure --records results/latest --scene simple --technique pcss --technique external:engine "
                 "--out engine.svg");
    verb->add_option("--scene", words->scene, "Scene id or file; with --records the id")->required();
    verb->add_option("--technique", words->techniques,
                     "Variant such as pcss:taps=32+32, or a glob over ids, from left to right; repeatable")
        ->required();
    addTechniqueFolderOption(*verb, words->techniques);
    verb->add_option("--inset", words->insets,
                     "Part to enlarge: left, top, width and height in pixels, such as 120,80,48,32; up to three times "
                     "(default: where the techniques differ most, of one technique where it errs most)");
    verb->add_flag("--shaded", words->shaded, "The scene with these shadows in place of visibility");
    CLI::Option* records =
        verb->add_option("--records", words->records,
                         "Records, or the folder of a run, whose images are shown; otherwise the cells are "
                         "drawn");
    verb->add_option("--images", words->images, "Folder of its images (default: images beside the records)")->needs(records);
    verb->add_option("--out", words->out, "File, whose name ends with .pdf, .png or .svg")->capture_default_str();
    addProfileOption(*verb, words->profile);
    addGlOption(*verb);
    verb->add_option("--cache", words->cache, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_flag("--quiet", words->quiet, "No progress");
    verb->callback([&action, words] { action = [words] { return makeFigure(*words); }; });
}

} // namespace shadowbench
