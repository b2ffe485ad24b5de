#include "site/viewer/cells.h"

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/kept_images.h"
#include "report/costing.h"
#include "report/run_report.h"
#include "report/summary.h"
#include "site/made_file.h"
#include "site/names.h"
#include "site/template.h"
#include "site/viewer/cell_data.h"
#include "site/viewer/pixel_script.h"
#include "site/viewer/shadow_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

/// Names of pictures in a scene's folder, without their endings.
std::string truthPicture(const std::string& name) { return "truth/" + name; }
std::string differenceOf(const std::string& cell) { return cell + "-difference"; }

constexpr std::size_t leastErrors = 10; // rows with a sequence where no time makes a front
constexpr std::array<std::string_view, 11> scripts{"pixels.js", "colours.js",  "worst.js",   "address.js",
                                                   "pane.js",   "controls.js", "readout.js", "pointer.js",
                                                   "keys.js",   "layers.js",   "viewer.js"};

/// To what a screen tells apart, so that it packs well.
std::vector<float> rounded(const Image<float>& direct) {
    constexpr float steps = 256;
    std::vector<float> values = valuesOf(direct);
    for (float& value : values) value = std::round(value * steps) / steps;
    return values;
}

bool hasImage(const Record& record, const fs::path& images) {
    if (images.empty() || !wasScored(record.status) || isLevelOfDetail(record)) return false;
    if (!isFolderName(record.scene) || !isFolderName(fileName(record.variant))) return false;
    return fs::exists(cellFolder(images, record.scene, record.variant) / "visibility.exr");
}

/// The files of one scene's cells.
class ScenePage {
public:
    /// `images`: the run whose truths are shown.
    ScenePage(const fs::path& images, const std::string& scene, fs::path site)
        : site_(std::move(site)), names_(keptTruths(images, scene)) {
        shown_.slug = slug(scene);
        shown_.title = truncate(scene);
        for (const std::string& name : names_) addTruth(name, truthFile(images, scene, name));
        if (const auto shading = readShading(shadingFile(images, scene))) addShading(*shading);
    }

    /// Writes the files of those that have an image, each once.
    void add(const std::vector<RunCell>& cells) {
        std::vector<const RunCell*> chosen;
        for (const RunCell& cell : cells)
            if (hasImage(cell.record, cell.images) && seen_.insert(slug(cell.name)).second) chosen.push_back(&cell);
        std::vector<std::optional<ShownCell>> made(chosen.size());
        inParallel(static_cast<int>(chosen.size()), availableThreads(), [&](int i) {
            const auto index = static_cast<std::size_t>(i);
            made[index] = write(*chosen[index]);
        });
        for (std::optional<ShownCell>& cell : made)
            if (cell) shown_.cells.push_back(std::move(*cell));
    }

    [[nodiscard]] bool hasTruth() const { return !names_.empty(); }
    [[nodiscard]] const ShownScene& shownScene() const { return shown_; }

private:
    /// Nothing if it is not of the truth's size.
    [[nodiscard]] std::optional<ShownCell> write(const RunCell& from) const {
        const fs::path folder = cellFolder(from.images, from.record.scene, from.record.variant);
        const Image<float> v = readChannel(folder / "visibility.exr", "V");
        ShownCell cell{
            slug(from.name), truncate(from.name), errorOf(from.record), truthOf(from.record, names_), {}, {}, {}, {}};
        const KeptTruth& truth = truths_.at(cell.truth);
        if (!v.sameSize(truth.visibility)) return {};
        cell.data = writeScript(cell.slug, {{"V", valuesOf(v)}});
        cell.picture = writePicture(cell.slug, visibilityPicture(v, truth));
        cell.difference = writePicture(differenceOf(cell.slug), differencePicture(v, truth));
        if (from.sequence) cell.sequence = sequenceOf(from, folder, cell.slug);
        return cell;
    }

    /// Address of a file of this scene from cells/.
    [[nodiscard]] std::string address(const std::string& name) const { return shown_.slug + "/" + name; }
    [[nodiscard]] fs::path file(const std::string& address) const { return site_ / "cells" / address; }

    std::string writeScript(const std::string& name,
                            const std::vector<std::pair<std::string, std::vector<float>>>& channels) const {
        writeMade(file(address(name) + ".js"), pixelScript(address(name), channels));
        return address(name);
    }

    std::string writePicture(const std::string& name, const Image<glm::vec3>& picture) const {
        writePng(file(address(name) + ".png"), picture);
        return address(name) + ".png";
    }

    std::string copyPicture(const std::string& name, const fs::path& from) const {
        writeMade(file(address(name) + ".png"), readFile(from));
        return address(name) + ".png";
    }

    void addTruth(const std::string& name, const fs::path& from) {
        const KeptTruth& truth = truths_[name] = readTruth(from);
        ShownTruth shown{name, truthLabel(name), {}, {}, hasExactEdges(truth)};
        shown.data = writeScript(truthPicture(name), {{"V", valuesOf(truth.visibility)},
                                                      {"sigma", valuesOf(truth.sigma)},
                                                      {"surface", valuesOf(truth.surface)},
                                                      {"edge", valuesOf(truth.edgeDistance)},
                                                      {"edges", shadowEdges(truth)}});
        shown.picture = writePicture(truthPicture(name), visibilityPicture(truth.visibility, truth));
        shown_.width = truth.visibility.width();
        shown_.height = truth.visibility.height();
        shown_.truths.push_back(std::move(shown));
    }

    void addShading(const PictureShading& shading) {
        if (shading.direct.width() != shown_.width || shading.direct.height() != shown_.height) return;
        std::vector<std::pair<std::string, std::vector<float>>> channels;
        for (int i = 0; i < 3; ++i) {
            auto& [name, light] = channels.emplace_back(std::array{"red", "green", "blue"}[i], std::vector<float>());
            for (const glm::vec3& ambient : shading.ambient) light.push_back(ambient[i]);
        }
        channels.emplace_back("direct", rounded(shading.direct));
        shown_.shading = writeScript("frame/shading", channels);
    }

    [[nodiscard]] std::optional<ShownSequence> sequenceOf(const RunCell& cell, const fs::path& folder,
                                                          const std::string& name) const {
        const std::string truth = movingTruthOf(cell.record);
        const fs::path exact = truthSequenceFile(cell.images, cell.record.scene, truth);
        if (!fs::exists(folder / "sequence.png") || !fs::exists(folder / "flicker.png") || !fs::exists(exact)) return {};
        ShownSequence sequence;
        sequence.count = readChannel(folder / "sequence.png", 0).height() / cell.record.height;
        sequence.moving = truth;
        sequence.picture = copyPicture(name + "-sequence", folder / "sequence.png");
        sequence.flicker = copyPicture(name + "-flicker", folder / "flicker.png");
        sequence.truth = copyPicture(truthPicture(truth) + "-sequence", exact);
        return sequence;
    }

    static std::string errorOf(const Record& record) {
        const auto error = headline(record);
        return error ? fmt::format("{} {}", error->metric, report::formatValue(error->metric, error->value)) : "";
    }

    fs::path site_;
    std::vector<std::string> names_;
    std::map<std::string, KeptTruth> truths_;
    std::set<std::string> seen_;
    ShownScene shown_;
};

/// Indices of the records of `scene` whose sequences are shown.
std::set<std::size_t> withSequence(const std::vector<Record>& records, const std::string& scene, Sequences sequences) {
    std::vector<std::size_t> rows = report::scoredOf(records, scene);
    if (sequences == Sequences::All) return {rows.begin(), rows.end()};
    const std::vector<std::size_t> front = report::paretoFront(records, scene, report::shownCosting(records, scene).of);
    if (!front.empty()) return {front.begin(), front.end()};
    std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return headline(records[i])->value; });
    return {rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), leastErrors))};
}

} // namespace

bool hasCell(const Record& record, const fs::path& images) {
    return hasImage(record, images) && !keptTruths(images, record.scene).empty();
}

bool writeCellPage(const std::vector<RunCell>& cells, const Link& back, SiteWriter& site) {
    ScenePage page(cells.front().images, cells.front().record.scene, site.folder());
    if (page.hasTruth()) page.add(cells);
    const ShownScene& scene = page.shownScene();
    if (scene.cells.empty()) return false;
    const std::string catalogue = fmt::format("cells/{}/cells.js", scene.slug);
    writeMade(site.folder() / catalogue, catalogueScript(scene));
    site.add({fmt::format("cells/{}.html", scene.slug),
              scene.title + ", pixel by pixel",
              cellsPage(scene, back),
              {"assets/viewer.js", catalogue},
              {"assets/style.css", "assets/viewer.css"}});
    return true;
}

void writeCells(const std::vector<Record>& records, const fs::path& images, SiteWriter& site, Sequences sequences,
                const std::vector<RunCell>& others) {
    bool any = false;
    for (const std::string& scene : report::scenes(records)) {
        const std::set<std::size_t> moving = withSequence(records, scene, sequences);
        std::vector<RunCell> cells;
        for (const std::size_t i : report::ofScene(records, scene))
            if (hasCell(records[i], images)) cells.push_back({records[i].variant, records[i], images, moving.contains(i)});
        // What draws no shadow is not what one comes to see first.
        std::ranges::stable_partition(cells, [](const RunCell& cell) { return !report::isBaseline(cell.record); });
        for (const RunCell& other : others)
            if (!cells.empty() && other.record.scene == scene) cells.push_back(other);
        if (!cells.empty() && writeCellPage(cells, {"Table and charts of " + truncate(scene), sceneAddress(scene)}, site))
            any = true;
    }
    if (any) writeViewer(site);
}

void writeViewer(const SiteWriter& site) {
    std::string script;
    for (const std::string_view file : scripts) script += embeddedFile(fmt::format("viewer/{}", file));
    writeMade(site.folder() / "assets/viewer.js", script);
    writeMade(site.folder() / "assets/viewer.css", embeddedFile("viewer/viewer.css"));
}

std::string cellAddress(const RunCell& cell, const RunCell* against) {
    const std::string address = fmt::format("cells/{}.html#{}", slug(cell.record.scene), slug(cell.name));
    return against == nullptr ? address : fmt::format("{}&against=cell:{}", address, slug(against->name));
}

std::optional<CellPictures> cellPictures(const RunCell& cell, const fs::path& truths, const SiteWriter& site) {
    if (!hasImage(cell.record, cell.images)) return std::nullopt;
    const std::vector<std::string> names = keptTruths(truths, cell.record.scene);
    if (names.empty()) return std::nullopt;
    const std::string folder = fmt::format("cells/{}/", slug(cell.record.scene)), own = slug(cell.name);
    const CellPictures pictures{folder + own + ".png", folder + truthPicture(truthOf(cell.record, names)) + ".png",
                                folder + differenceOf(own) + ".png"};
    const bool written = fs::exists(site.folder() / pictures.technique) && fs::exists(site.folder() / pictures.truth);
    return written ? std::optional(pictures) : std::nullopt;
}

std::optional<CellPictures> shadedPictures(const RunCell& cell, const SiteWriter& site) {
    std::optional<CellPictures> pictures = cellPictures(cell, cell.images, site);
    if (!pictures) return std::nullopt;
    const std::string& scene = cell.record.scene;
    const auto shading = readShading(shadingFile(cell.images, scene));
    const std::string truth = truthOf(cell.record, keptTruths(cell.images, scene));
    const std::pair<std::string&, fs::path> shaded[] = {
        {pictures->technique, cellFolder(cell.images, scene, cell.record.variant) / "visibility.exr"},
        {pictures->truth, truthFile(cell.images, scene, truth)}};
    for (const auto& [address, file] : shaded) {
        const Image<float> v = readChannel(file, "V");
        if (!shading || !v.sameSize(shading->direct)) return std::nullopt;
        address.insert(address.size() - std::string_view(".png").size(), "-shaded");
        writePng(site.folder() / address, shadedPicture(*shading, v));
    }
    return pictures;
}

std::vector<Link> truthPictures(const std::string& scene, const fs::path& images, const SiteWriter& site) {
    std::vector<Link> pictures;
    if (images.empty() || !isFolderName(scene)) return pictures;
    for (const std::string& name : keptTruths(images, scene)) {
        const std::string address = fmt::format("cells/{}/{}.png", slug(scene), truthPicture(name));
        if (fs::exists(site.folder() / address)) pictures.push_back({truthLabel(name), address});
    }
    return pictures;
}

} // namespace shadowbench::site
