#include "base/folder_lock.h"
#include "base/progress_line.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/run_result.h"
#include "harness/cells/cell_selection.h"
#include "harness/foreign/score_images.h"
#include "techniques/gl/context.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace shadowbench {
namespace {

using Files = std::vector<std::filesystem::path>;

/// The command line's own words, checked by `rowOf`.
struct ScoreWords {
    std::string scene, definition, channel, id = "image", renderer, depthIs = "z", profile = "gate";
    Files images, lit, unlit, hits, depth;
    std::vector<int> frames;
    bool linear = false, srgb = false, history = false, leaveOutEdges = false, force = false, quiet = false;
    std::filesystem::path out = "results/score", cache;
};

/// 60 of ".../frame-60.exr"; nothing of other names.
std::optional<int> frameInName(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    const std::string_view before = "frame-";
    const std::string digits = stem.starts_with(before) ? stem.substr(before.size()) : "";
    const bool number = !digits.empty() && digits.size() < 8 && digits.find_first_not_of("0123456789") == std::string::npos;
    return number ? std::optional(std::stoi(digits)) : std::nullopt;
}

/// The frames that the images are of: as said, as their names say, or in the order of the scored ones.
std::vector<int> framesOf(const ScoreWords& words, const Scene& scene) {
    if (!words.frames.empty()) return words.frames;
    std::vector<int> frames;
    for (const auto& file : words.images)
        if (const auto frame = frameInName(file)) frames.push_back(*frame);
    if (frames.size() == words.images.size()) return frames;
    frames = scoredFrames(scene);
    frames.resize(std::min(frames.size(), words.images.size()));
    return frames;
}

/// The file beside image `i`, of files that are given for each image or not at all.
std::optional<std::filesystem::path> beside(const Files& files, std::size_t i, std::size_t images, std::string_view option) {
    if (files.empty()) return {};
    if (files.size() != images)
        throw BadInput(fmt::format("{} names {} files and --image {}: give one for each image, in the same order", option,
                                   files.size(), images));
    return files[i];
}

foreign::ForeignRow rowOf(const ScoreWords& words, const Scene& scene) {
    foreign::ForeignRow row;
    row.id = words.id;
    row.definition = foreign::definitionNamed(words.definition);
    if (words.linear) row.encoding = foreign::Encoding::Linear;
    if (words.srgb) row.encoding = foreign::Encoding::Srgb;
    row.channel = words.channel;
    row.depth = words.depthIs == "z" ? foreign::Depth::AlongView : foreign::Depth::FromEye;
    row.remembers = words.history;
    row.leaveOutEdges = words.leaveOutEdges;
    row.force = words.force;
    row.renderer = words.renderer;
    const std::vector<int> frames = framesOf(words, scene);
    const std::size_t images = words.images.size();
    if (frames.size() != images)
        throw BadInput(
            fmt::format("{} images and {} frames: name the frame of each image by --frame, in the same order; scene "
                        "{} is scored on {} frames",
                        images, frames.size(), scene.id, scoredFrames(scene).size()));
    for (std::size_t i = 0; i < images; ++i)
        row.frames.push_back({.frame = frames[i],
                              .image = words.images[i],
                              .lit = beside(words.lit, i, images, "--lit"),
                              .unlit = beside(words.unlit, i, images, "--unlit"),
                              .hits = beside(words.hits, i, images, "--hits"),
                              .depth = beside(words.depth, i, images, "--depth")});
    std::ranges::stable_sort(row.frames, {}, &foreign::FrameFiles::frame);
    return row;
}

/// The records of the folder with `record` in place of the one of the same row, or after the others.
std::vector<Record> joined(const std::filesystem::path& out, const Record& record) {
    const std::filesystem::path file = out / "results.jsonl";
    std::vector<Record> records;
    if (std::filesystem::exists(file)) records = readRecords(file);
    const auto same = std::ranges::find_if(records, [&](const Record& r) {
        return r.scene == record.scene && r.variant == record.variant && r.profile == record.profile;
    });
    if (same == records.end())
        records.push_back(record);
    else
        *same = record;
    return records;
}

ExitCode score(const ScoreWords& words) {
    const Scene scene = chosenScenes({words.scene}, profileNamed(words.profile)).front();
    const foreign::ForeignRow row = rowOf(words, scene);
    foreign::requireScorable(scene, row);
    const groundtruth::Cache cache(words.cache.empty() ? groundtruth::defaultCacheFolder() : words.cache);
    Truths truths(scene, cache);
    const auto needed = foreign::truthsOf(scene, row);
    ProgressLine line("truth", static_cast<int>(needed.size()), words.quiet);
    int done = 0;
    for (const auto& [truth, frame] : needed) {
        const std::string what = fmt::format("{} truth of frame {}", name(truth), frame);
        truths.at(truth, frame, [&](double share, std::string_view) { line.show(done, share, what); });
        line.show(++done, 0, what);
    }
    const auto context = gl::Context::create();
    std::vector<std::string> warnings;
    Record record;
    {
        SceneFrames frames(scene, truths);
        record = foreign::scoreImages(frames, row, warnings);
    }
    for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
    const OutputLock alone(words.out); // from reading the other rows to writing all: none is lost
    const std::vector<Record> records = joined(words.out, record);
    writeRecords(words.out / "results.jsonl", records);
    return reportResult({records, ExitCode::Pass}, words.out);
}

} // namespace

void addScore(CLI::App& app, Action& action) {
    const auto words = std::make_shared<ScoreWords>();
    CLI::App* verb = app.add_subcommand("score", "Scores images of another renderer against the truth");
    verb->footer(
        "Examples:\n  shadowbench export stacked-plates --out plates      (what to render: plates/scene.gltf, scene.json)\n"
        "  shadowbench score --scene stacked-plates --image plates.exr --definition hard --name my-engine --out "
        "results/mine\n"
        "  shadowbench score --scene stacked-plates --image shadows.png --lit no-shadows.png --unlit no-light.png --srgb "
        "--definition hard\n"
        "  shadowbench score --scene windmills --image out/frame-*.exr --definition hard --out results/mine\n"
        "Exits with 2, and scores nothing, when an image is damaged, of another size, or looks black, flipped, shifted, of\n"
        "another frame or wrongly encoded; what is only suspected is a warning. docs/score.md has one example end to end.");
    verb->add_option("--scene", words->scene, "Scene id or file")->required();
    verb->add_option("--image", words->images,
                     "EXR, PNG (8 or 16 bit) or PFM: 1 where a receiver is lit, 0 in shadow; several for several frames")
        ->required();
    verb->add_option("--frame", words->frames,
                     "Which frame each image is of (default: as frame-60.exr says, else the scored ones in their order)");
    verb->add_option("--definition", words->definition, "What the images show")
        ->required()
        ->type_name("TEXT:{hard,area,irradiance,solid-angle}");
    verb->add_option("--lit", words->lit,
                     "The same pictures without shadows: --image are then shaded pictures, and visibility "
                     "is (image - unlit) / (lit - unlit)");
    verb->add_option("--unlit", words->unlit, "The same without that light (default: black)");
    verb->add_option("--hits", words->hits, "Where the renderer saw something: > 0.5 of its hit mask");
    verb->add_option("--depth", words->depth, "How far what it saw was, in metres");
    verb->add_option("--depth-is", words->depthIs, "Of --depth: z, along the viewing direction, or distance, from the eye")
        ->check(CLI::IsMember({"z", "distance"}))
        ->capture_default_str();
    CLI::Option* linear = verb->add_flag("--linear", words->linear, "The numbers are linear (default of EXR and PFM)");
    verb->add_flag("--srgb", words->srgb,
                   "The numbers are sRGB-encoded; an 8 or 16 bit file must be said to be one or the other")
        ->excludes(linear);
    verb->add_option("--channel", words->channel,
                     "Channel of the images (default: the only one, or the grey of R, G and B)");
    verb->add_option("--name", words->id, "Name of the row: its technique is external:NAME")->capture_default_str();
    verb->add_option("--renderer", words->renderer, "What drew the images, with its version and device, for the record");
    verb->add_flag("--history", words->history, "The renderer keeps a history from frame to frame: look for ghosts");
    verb->add_flag("--leave-out-edges", words->leaveOutEdges, "Score nothing where geometry has edges");
    verb->add_flag("--force", words->force, "Score what looks black, flipped, shifted or wrongly encoded, with a warning");
    addProfileOption(*verb, words->profile);
    verb->add_option("--out", words->out, "Folder of records and report; rows that it already holds stay")
        ->capture_default_str();
    verb->add_option("--cache", words->cache, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_flag("--quiet", words->quiet, "No progress");
    verb->callback([&action, words] { action = [words] { return score(*words); }; });
}

} // namespace shadowbench
