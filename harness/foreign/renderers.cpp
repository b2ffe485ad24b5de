#include "harness/foreign/renderers.h"

#include "base/error.h"
#include "base/files.h"
#include "base/git.h"
#include "base/hash.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "harness/cells/renderer_log.h"
#include "harness/foreign/call_renderer.h"
#include "harness/foreign/renderer.h"
#include "harness/foreign/score_images.h"
#include "scene/exchange/export.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <unistd.h>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;
using techniques::Variant;

techniques::Entry entryOf(const Renderer& renderer) {
    techniques::Entry entry{};
    entry.id = std::string(externalPrefix) + renderer.id;
    entry.title = renderer.title;
    entry.answer = renderer.definition == Definition::Hard ? techniques::Answer::Filtered : techniques::Answer::Soft;
    return entry;
}

std::vector<int> framesOf(const Scene& scene, const Renderer& renderer) {
    std::vector<int> frames = scoredFrames(scene);
    if (!renderer.moving) frames.resize(1);
    return frames;
}

/// The row that the renderer gives, with the images that it wrote.
ForeignRow rowOf(const Renderer& renderer, std::vector<FrameFiles> frames) {
    return {.id = renderer.id,
            .definition = renderer.definition,
            .encoding = renderer.encoding,
            .frames = std::move(frames),
            .channel = renderer.channel,
            .depth = renderer.depth,
            .remembers = renderer.remembers,
            .leaveOutEdges = renderer.leaveOutEdges,
            .force = renderer.force,
            .renderer = renderer.source,
            .parameters = renderer.settings};
}

/// The row before any image is there.
ForeignRow plannedRow(const Scene& scene, const Renderer& renderer) {
    std::vector<FrameFiles> frames;
    for (const int frame : framesOf(scene, renderer)) frames.push_back({.frame = frame, .image = ""});
    return rowOf(renderer, std::move(frames));
}

/// The files that a command names, by their content: another script is another renderer. Of a line for the shell only the
/// programs: it may name what it writes, too.
std::string contentOf(const Renderer& renderer) {
    std::string text;
    for (const std::string& words : renderer.command) {
        std::istringstream each(words); // a line for the shell has several
        for (std::string word; each >> word;) {
            std::error_code ignored;
            const fs::path file = renderer.folder / word;
            const bool counts = !renderer.isShellLine || access(file.c_str(), X_OK) == 0;
            if (counts && fs::is_regular_file(file, ignored))
                text += fmt::format("{} {}\n", word, hash128(readFile(file)).text());
        }
    }
    return text;
}

/// A complaint about images in words of a TOML file: without the folder, which is gone by the time it is read, and with keys
/// for the options of `score`.
std::string inWordsOfTheFile(std::string text, const fs::path& folder) {
    const std::vector<std::pair<std::string, std::string>> words{
        {folder.string() + "/", ""},        {"--lit", "frame-…-lit"},   {"--unlit", "frame-…-unlit"},
        {"--force", "`force = true`"},      {"--channel", "`channel`"}, {"--linear", "`encoding = \"linear\"`"},
        {"--srgb", "`encoding = \"srgb\"`"}};
    for (const auto& [option, key] : words)
        for (std::size_t at = text.find(option); at != std::string::npos; at = text.find(option, at + key.size()))
            text.replace(at, option.size(), key);
    return text;
}

/// As git describes what a file lies in; "" in no repository.
std::string describedRevision(const fs::path& file) {
    const auto lines = git(fs::absolute(file).parent_path(), {"describe", "--always", "--dirty"});
    return lines && !lines->empty() ? lines->back() : ""; // its warnings come first
}

class Renderers : public ExternalTechniques {
public:
    Renderers(const std::vector<fs::path>& files, RendererOptions options)
        : variables_(ownEnvironment()), options_(std::move(options)) {
        for (const fs::path& file : files) {
            const std::string revision = options_.revision.empty() ? describedRevision(file) : options_.revision;
            for (Renderer& renderer : readRenderers(file)) add(std::move(renderer), file, revision);
        }
    }

    [[nodiscard]] const std::vector<Variant>& variants() const override { return variants_; }

    [[nodiscard]] std::optional<std::string> notApplicable(const Scene& scene, const Variant& variant) const override {
        if (!of(variant).draws(scene.light.kind))
            return fmt::format("{} draws no light of kind {}", of(variant).id, name(scene.light.kind));
        try {
            requireScorable(scene, plannedRow(scene, of(variant)));
            return std::nullopt;
        } catch (const BadInput& error) {
            return error.what();
        }
    }

    [[nodiscard]] std::vector<std::pair<Truth, int>> truthsOf(const Scene& scene, const Variant& variant) const override {
        return foreign::truthsOf(scene, plannedRow(scene, of(variant)));
    }

    [[nodiscard]] std::string cellId(const Truths& truths, const Scene& scene, const Variant& variant) const override {
        const Renderer& renderer = of(variant);
        const std::string row = foreign::cellId(truths, scene, plannedRow(scene, renderer));
        return hash128(fmt::format("external cell 1\n{}\n{}", row, renderer.text)).text();
    }

    void score(SceneFrames& frames, const Variant& variant, Record& record, CellImages& images,
               const Progress& progress) const override {
        progress(0, variant.name);
        std::string said;
        try {
            callAndScore(frames, variant, record, images, said);
            keepSaid(frames.scene(), variant, "");
        } catch (const Error&) {
            keepSaid(frames.scene(), variant, said);
            throw;
        }
    }

    [[nodiscard]] ExternalInfo describe(const Variant& variant) const override {
        const Renderer& renderer = of(variant);
        return {renderer.title, renderer.source, {}, revisions_.at(variant.name)};
    }

private:
    void callAndScore(SceneFrames& frames, const Variant& variant, Record& record, CellImages& images,
                      std::string& said) const {
        const Renderer& renderer = of(variant);
        const TemporaryFolder folder;
        const fs::path exported = folder.path() / "scene", out = folder.path() / "out";
        fs::create_directories(out);
        const OnLine keepLine = [&](std::string_view line) { said += std::string(line) + "\n"; };
        try {
            exchange::exportScene(frames.scene(), exported);
            Rendered rendered =
                callRenderer(renderer, exported, framesOf(frames.scene(), renderer), out, variables_, keepLine);
            scoreRow(frames, rowOf(renderer, std::move(rendered.frames)), record, images);
            record.external = describe(variant);
            record.external->reported = rendered.reported;
        } catch (const BadInput& error) {
            throw Inconclusive(inWordsOfTheFile(error.what(), out));
        } catch (const fs::filesystem_error& error) { // it has removed its folder, or taken our rights away
            throw Inconclusive(inWordsOfTheFile(fmt::format("its files cannot be read: {}", error.what()), out));
        }
    }

    /// In place of what an earlier call said.
    void keepSaid(const Scene& scene, const Variant& variant, const std::string& said) const {
        if (options_.logs.empty()) return;
        const fs::path log = rendererLog(options_.logs, scene.id, variant.name);
        fs::remove(log);
        if (!said.empty()) writeFileUnflushed(log, said);
    }

    void add(Renderer renderer, const fs::path& file, const std::string& revision) {
        const std::string name = std::string(externalPrefix) + renderer.id;
        if (renderers_.contains(name))
            throw BadInput(fmt::format("{}: the renderer {} is in another file of --external, too; give one of them "
                                       "another id",
                                       file.string(), renderer.id));
        const techniques::Entry& entry = entries_.emplace_back(entryOf(renderer));
        renderer.text += contentOf(renderer);
        revisions_.emplace(name, revision);
        variants_.push_back({&entry, techniques::Parameters(renderer.settings), name});
        renderers_.emplace(name, std::move(renderer));
    }

    [[nodiscard]] const Renderer& of(const Variant& variant) const { return renderers_.at(variant.name); }

    /// Keeps of the blank record what says which run it is of.
    static void scoreRow(SceneFrames& frames, const ForeignRow& row, Record& record, CellImages& images) {
        std::vector<std::string> warnings;
        Record scored = scoreImages(frames, row, warnings, &images);
        scored.cell = record.cell;
        scored.seed = record.seed;
        record = std::move(scored);
        for (const std::string& warning : warnings)
            fmt::print(stderr, "warning: {} on {}: {}\n", record.variant, record.scene,
                       inWordsOfTheFile(warning, row.frames.front().image.parent_path()));
    }

    std::vector<std::string> variables_;
    RendererOptions options_;
    std::deque<techniques::Entry> entries_; // the variants point to them
    std::vector<Variant> variants_;
    std::map<std::string, Renderer> renderers_;    // by the variant's name …
    std::map<std::string, std::string> revisions_; // … and these
};

} // namespace

std::shared_ptr<const ExternalTechniques> renderersOf(const std::vector<fs::path>& files, const RendererOptions& options) {
    return files.empty() ? nullptr : std::make_shared<const Renderers>(files, options);
}

} // namespace shadowbench::foreign
