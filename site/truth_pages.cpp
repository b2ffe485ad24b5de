// What the truths are made by, and how sure they are: as the records say it, with the truths' pictures where there are any.
#include "report/summary.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::site {
namespace {

std::string truthAddress(const std::string& scene) { return fmt::format("truth/{}.html", slug(scene)); }

struct SceneTruth {
    std::string kind;
    ReferenceInfo info;
};

/// The truths of a scene, each once.
std::vector<SceneTruth> truthsOf(const std::vector<Record>& records, const std::string& scene) {
    std::vector<SceneTruth> found;
    const auto add = [&](const std::optional<ReferenceInfo>& info, const char* kind) {
        if (!info || std::ranges::any_of(found, [&](const SceneTruth& known) { return known.info.key == info->key; }))
            return;
        found.push_back({kind, *info});
    };
    for (const std::size_t i : report::ofScene(records, scene)) {
        const Record& record = records[i];
        const std::string oracle = record.reference ? record.reference->oracle : "";
        add(record.reference, isLevelOfDetail(record) ? "colours at full detail"
                              : oracle == "povray"    ? "visible fraction of the light"
                                                      : "lit or shadowed");
        add(record.softReference, "visible fraction of the light");
        add(record.pixelReference, "mean over each pixel's square");
    }
    return found;
}

std::string toolsOf(const ReferenceInfo& info) {
    std::vector<std::string> tools;
    for (const auto& [tool, version] : info.tools) tools.push_back(tool + " " + version);
    return fmt::format("{}", fmt::join(tools, ", "));
}

Cell sigmaCell(const ReferenceInfo& info) {
    return info.sigma > 0 ? Cell{fmt::format("{:.2g}", info.sigma), info.sigma} : Cell{"exact", 0.0};
}

std::vector<Cell> infoCells(const SceneTruth& truth) {
    const ReferenceInfo& info = truth.info;
    return {Cell{truth.kind},
            Cell{info.oracle},
            sigmaCell(info),
            info.samples > 0 ? Cell{std::to_string(info.samples), static_cast<double>(info.samples)} : Cell{"–"},
            info.area ? Cell{fmt::format("{:.2g}", info.area->rms), info.area->rms} : Cell{"–"},
            Cell{toolsOf(info)}};
}

std::vector<Column> infoColumns() {
    return {{.title = "what is true", .number = false},
            {.title = "oracle", .number = false},
            {.title = "σ", .hint = "Of the sampled truth, rms over the penumbra"},
            {.title = "samples"},
            {.title = "against exact areas",
             .hint = "Rms of the sampled truth against the exact visible fraction, over the penumbra"},
            {.title = "made by", .number = false}};
}

Table overview(const std::vector<Record>& records) {
    Table table{.id = "truths",
                .caption = "What every scene was scored against",
                .columns = infoColumns(),
                .rows = {},
                .headed = false,
                .stacked = true};
    table.columns.insert(table.columns.begin(), {.title = "scene", .number = false});
    for (const std::string& scene : report::scenes(records))
        for (const SceneTruth& truth : truthsOf(records, scene)) {
            Row row{infoCells(truth), {}};
            row.cells.insert(row.cells.begin(), Cell{.text = scene, .address = truthAddress(scene)});
            table.rows.push_back(std::move(row));
        }
    return table;
}

void addTruthPage(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images,
                  SiteWriter& site) {
    const std::string address = truthAddress(scene);
    Table table{.id = "truths", .caption = "The truths of " + scene, .columns = infoColumns(), .rows = {}, .stacked = true};
    table.columns.push_back({.title = "key", .number = false, .brief = false});
    table.columns.push_back({.title = "hash of the pixels", .number = false, .brief = false});
    for (const SceneTruth& truth : truthsOf(records, scene)) {
        Row row{infoCells(truth), {}};
        row.cells.push_back({.text = truth.info.key, .kind = "hash"});
        row.cells.push_back({.text = truth.info.content.empty() ? "–" : truth.info.content, .kind = "hash"});
        table.rows.push_back(std::move(row));
    }
    Data data, list{Data::type::list};
    for (const Link& picture : truthPictures(scene, images, site)) {
        Data entry;
        entry.set("source", "../" + picture.address);
        entry.set("caption", picture.title);
        entry.set("text", fmt::format("True visibility on {}: {}", truncate(scene), picture.title));
        list << entry;
    }
    data.set("scene", truncate(scene));
    data.set("there", "../" + sceneAddress(scene));
    data.set("pictures", list);
    data.set("table", site.table(address, table));
    site.add({address, "Truth of " + truncate(scene), render("truth.html", data)});
}

} // namespace

void addTruthPages(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site) {
    for (const std::string& scene : report::scenes(records)) addTruthPage(records, scene, images, site);
    Data data;
    data.set("title", "Truth");
    data.set("described", "Every score says what it was taken against. Exact truths have no error but that of arithmetic, "
                          "which is exact, too; of sampled ones σ says how sure they are.");
    data.set("chart", "");
    data.set("table", site.table("truth.html", overview(records)));
    site.add({"truth.html", "Truth", render("chart-page.html", data)});
}

} // namespace shadowbench::site
