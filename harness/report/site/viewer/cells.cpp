#include "harness/report/site/viewer/cells.h"

#include "base/files.h"
#include "base/image_io.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/kept_images.h"
#include "harness/report/run_report.h"
#include "harness/report/site/names.h"
#include "harness/report/site/template.h"
#include "harness/report/site/viewer/cell_data.h"
#include "harness/report/site/viewer/pixel_script.h"
#include "harness/report/site/viewer/shadow_edges.h"
#include "harness/report/summary.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t leastErrors = 10; // rows with a sequence where no time makes a front
constexpr std::array<std::string_view, 11> scripts{"pixels.js", "colours.js",  "worst.js",   "address.js",
                                                   "pane.js",   "controls.js", "readout.js", "pointer.js",
                                                   "keys.js",   "layers.js",   "viewer.js"};

/// The files of one scene's cells.
class ScenePage {
public:
    ScenePage(fs::path images, std::string scene, const fs::path& site)
        : images_(std::move(images)), scene_(std::move(scene)), site_(site), names_(keptTruths(images_, scene_)) {
        shown_.slug = slug(scene_);
        shown_.title = shown(scene_);
        for (const std::string& name : names_) addTruth(name);
    }

    void add(const Record& record, bool withSequence) {
        const fs::path folder = cellFolder(images_, scene_, record.variant);
        const Image<float> v = readChannel(folder / "visibility.exr", "V");
        ShownCell cell{
            slug(record.variant), shown(record.variant), errorOf(record), truthOf(record, names_), {}, {}, {}, {}};
        const KeptTruth& truth = truths_.at(cell.truth);
        if (!v.sameSize(truth.visibility) || !seen_.insert(cell.slug).second) return;
        shown_.width = v.width();
        shown_.height = v.height();
        cell.data = writeScript(cell.slug, {{"V", valuesOf(v)}});
        cell.picture = writePicture(cell.slug, visibilityPicture(v, truth));
        cell.difference = writePicture(cell.slug + "-difference", differencePicture(v, truth));
        if (withSequence) cell.sequence = sequenceOf(record, folder, cell.slug);
        shown_.cells.push_back(std::move(cell));
    }

    [[nodiscard]] const ShownScene& shownScene() const { return shown_; }

private:
    /// Address of a file of this scene from cells/.
    [[nodiscard]] std::string address(const std::string& name) const { return shown_.slug + "/" + name; }
    [[nodiscard]] fs::path file(const std::string& address) const { return site_ / "cells" / address; }

    std::string writeScript(const std::string& name,
                            const std::vector<std::pair<std::string, std::vector<float>>>& channels) const {
        writeFile(file(address(name) + ".js"), pixelScript(address(name), channels));
        return address(name);
    }

    std::string writePicture(const std::string& name, const Image<glm::vec3>& picture) const {
        writePng(file(address(name) + ".png"), picture);
        return address(name) + ".png";
    }

    std::string copyPicture(const std::string& name, const fs::path& from) const {
        writeFile(file(address(name) + ".png"), readFile(from));
        return address(name) + ".png";
    }

    void addTruth(const std::string& name) {
        const KeptTruth& truth = truths_[name] = readTruth(truthFile(images_, scene_, name));
        ShownTruth shown{name, truthLabel(name), {}, {}, hasExactEdges(truth)};
        shown.data = writeScript("truth/" + name, {{"V", valuesOf(truth.visibility)},
                                                   {"sigma", valuesOf(truth.sigma)},
                                                   {"surface", valuesOf(truth.surface)},
                                                   {"edge", valuesOf(truth.edgeDistance)},
                                                   {"edges", shadowEdges(truth)}});
        shown.picture = writePicture("truth/" + name, visibilityPicture(truth.visibility, truth));
        shown_.truths.push_back(std::move(shown));
    }

    [[nodiscard]] std::optional<ShownSequence> sequenceOf(const Record& record, const fs::path& folder,
                                                          const std::string& name) const {
        const std::string truth = record.pixelReference ? "pixel-area" : ownTruth(record);
        const fs::path exact = truthSequenceFile(images_, scene_, truth);
        if (!fs::exists(folder / "sequence.png") || !fs::exists(folder / "flicker.png") || !fs::exists(exact)) return {};
        ShownSequence sequence;
        sequence.count = readChannel(folder / "sequence.png", 0).height() / record.height;
        sequence.moving = truth;
        sequence.picture = copyPicture(name + "-sequence", folder / "sequence.png");
        sequence.flicker = copyPicture(name + "-flicker", folder / "flicker.png");
        sequence.truth = copyPicture("truth/" + truth + "-sequence", exact);
        return sequence;
    }

    static std::string ownTruth(const Record& record) {
        return record.reference && record.reference->oracle == "povray" ? "soft" : "hard";
    }

    static std::string errorOf(const Record& record) {
        const auto error = headline(record);
        return error ? fmt::format("{} {}", error->metric, report::formatValue(error->metric, error->value)) : "";
    }

    fs::path images_;
    std::string scene_;
    fs::path site_;
    std::vector<std::string> names_;
    std::map<std::string, KeptTruth> truths_;
    std::set<std::string> seen_;
    ShownScene shown_;
};

/// Indices of the records of `scene` whose sequences are shown.
std::set<std::size_t> withSequence(const std::vector<Record>& records, const std::string& scene, Sequences sequences) {
    std::vector<std::size_t> rows = report::ofScene(records, scene);
    if (sequences == Sequences::All) return {rows.begin(), rows.end()};
    const std::vector<std::size_t> front = report::paretoFront(records, scene);
    if (!front.empty()) return {front.begin(), front.end()};
    std::erase_if(rows, [&](std::size_t i) { return !headline(records[i]); });
    std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return headline(records[i])->value; });
    return {rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), leastErrors))};
}

void writeScene(const std::vector<Record>& records, const std::vector<std::size_t>& cells, const fs::path& images,
                SiteWriter& site, Sequences sequences) {
    const std::string& scene = records[cells.front()].scene;
    const std::set<std::size_t> moving = withSequence(records, scene, sequences);
    ScenePage page(images, scene, site.folder());
    for (const std::size_t i : cells) page.add(records[i], moving.contains(i));
    const ShownScene& shownScene = page.shownScene();
    if (shownScene.cells.empty()) return;
    const std::string catalogue = fmt::format("cells/{}/cells.js", shownScene.slug);
    writeFile(site.folder() / catalogue, catalogueScript(shownScene));
    site.add({fmt::format("cells/{}.html", shownScene.slug),
              shownScene.title + ", pixel by pixel",
              cellsPage(shownScene),
              {"assets/viewer.js", catalogue}});
}

void writeAssets(const fs::path& site) {
    std::string script;
    for (const std::string_view file : scripts) script += embeddedFile(fmt::format("viewer/{}", file));
    writeFile(site / "assets/viewer.js", script);
    writeFile(site / "assets/viewer.css", embeddedFile("viewer/viewer.css"));
}

} // namespace

bool hasCell(const Record& record, const fs::path& images) {
    if (images.empty() || !wasScored(record.status) || isLevelOfDetail(record)) return false;
    if (!isFolderName(record.scene) || !isFolderName(fileName(record.variant))) return false;
    return fs::exists(cellFolder(images, record.scene, record.variant) / "visibility.exr") &&
           !keptTruths(images, record.scene).empty();
}

void writeCells(const std::vector<Record>& records, const fs::path& images, SiteWriter& site, Sequences sequences) {
    bool any = false;
    for (const std::string& scene : report::scenes(records)) {
        std::vector<std::size_t> cells = report::ofScene(records, scene);
        std::erase_if(cells, [&](std::size_t i) { return !hasCell(records[i], images); });
        if (cells.empty()) continue;
        writeScene(records, cells, images, site, sequences);
        any = true;
    }
    if (any) writeAssets(site.folder());
}

} // namespace shadowbench::site
