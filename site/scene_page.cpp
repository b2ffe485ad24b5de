// The page of one scene.
#include "report/cost_report.h"
#include "report/lod_report.h"
#include "report/run_text.h"
#include "report/summary.h"
#include "site/charts.h"
#include "site/choice.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/scene_tables.h"
#include "site/technique_facts.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::site {
namespace {

/// "512², 60 frames; error: mismatching pixels; tolerance: mismatch 0.5 %; truth: exact (polygon)".
std::string describe(const std::vector<Record>& records, const std::string& scene) {
    const Record& first = records[report::ofScene(records, scene).front()];
    std::string text = fmt::format("{} pixels, {} frames", report::imageSize(first), first.frames);
    if (const std::string metric = report::headlineMetric(records, scene); !metric.empty())
        text += "; error: " + report::meaning(metric);
    const std::vector<report::Tolerance> limits = report::tolerances(records, scene);
    text += limits.empty() ? "; the scene states no tolerance" : "; a viewer accepts " + report::formatBounds(limits);
    const std::string truth = report::sceneTruth(records, scene);
    return text + (truth.empty() ? "" : "; truth: " + truth) + ".";
}

std::string namesOf(const std::vector<Record>& records, const std::vector<std::size_t>& indices,
                    const report::Costing& costing) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(indices.size(), most); ++i) {
        const auto cost = costing.of(records[indices[i]]);
        text += fmt::format("{}{}", text.empty() ? "" : ", ", truncate(records[indices[i]].variant));
        if (cost) text += fmt::format(" ({:.2f} {})", cost->ratio, costing.unit);
    }
    return indices.size() > most ? fmt::format("{} and {} more", text, indices.size() - most) : text;
}

Data pictureData(const std::string& address, const std::string& caption, const std::string& to) {
    Data data;
    data.set("source", "../" + address);
    data.set("picture", caption);
    data.set("linked", !to.empty());
    data.set("to", "../" + to);
    return data;
}

/// Truth, what the chosen technique shows, and where that is wrong: of the scene where it is known how it is lit, else of
/// visibility alone.
Data pictures(const Record& record, const std::filesystem::path& images, const SiteWriter& site) {
    Data list{Data::type::list};
    const RunCell shown{record.variant, record, images};
    const std::optional<CellPictures> shaded = shadedPictures(shown, site);
    const std::optional<CellPictures> cell = shaded ? shaded : cellPictures(shown, images, site);
    if (!cell) return list;
    const std::string to = cellAddress(record) + (shaded ? "&shaded=1" : "");
    list << pictureData(cell->truth, "truth", to);
    list << pictureData(cell->technique, "what it shows", to);
    list << pictureData(cell->difference, "error: orange too dark, blue too bright", to);
    return list;
}

void setAnswer(Data& data, const std::vector<Record>& records, const Choice& choice, const std::filesystem::path& images,
               const SiteWriter& site) {
    data.set("answered", choice.take.has_value());
    data.set("why", choice.why);
    data.set("adequate", choice.adequate);
    if (!choice.take) return;
    const Record& record = records[*choice.take];
    const report::Costing costing = report::shownCosting(records, record.scene);
    const auto cost = costing.of(record);
    const std::string weakness = report::admittedFailure(record.technique);
    data.set("take", truncate(record.variant));
    data.set("name", truncate(factsOf(record.technique).title));
    data.set("errs", errorText(record));
    data.set("timed", cost.has_value());
    data.set("cost", cost ? fmt::format("{:.2f}", cost->ratio) : "");
    data.set("frames", costing.meaning);
    data.set("weak", !weakness.empty());
    data.set("weakness", weakness);
    data.set("others", namesOf(records, choice.others, costing));
    data.set("rivals", !choice.others.empty());
    data.set("noted", !choice.notes.empty());
    data.set("notes", fmt::format("{}", fmt::join(choice.notes, "; ")));
    data.set("pictures", pictures(record, images, site));
}

/// The charts that the report has drawn, in their places on the page.
class SceneCharts {
public:
    SceneCharts(const std::vector<Record>& records, const std::string& scene, const SiteWriter& site)
        : records_(records), scene_(scene), site_(site) {}

    /// `drawn`: the files of all charts that there are.
    [[nodiscard]] std::string place(const std::vector<std::filesystem::path>& drawn, const Chart& chart) const {
        const std::filesystem::path file = site_.folder() / (chart.name + ".svg");
        if (std::ranges::find(drawn, file) == drawn.end()) return "";
        writePdf(site_, chart.name);
        return site_.chart(sceneAddress(scene_), chart);
    }

    /// A chart that a script alone draws.
    [[nodiscard]] std::string scripted(const std::string& title, const std::string& table, const std::string& xLabel,
                                       const std::string& yLabel) const {
        return site_.chart(sceneAddress(scene_), {.name = {},
                                                  .title = title,
                                                  .text = title,
                                                  .kind = "lines",
                                                  .table = table,
                                                  .options = {{"xlabel", xLabel}, {"ylabel", yLabel}}});
    }

    [[nodiscard]] Chart convergence() const {
        return {.name = "convergence-" + slug(scene_),
                .title = "Error over the still frames, from an empty history.",
                .text = "Error of each still frame; the figures are in the table below.",
                .kind = "lines",
                .table = "convergence",
                .options = {{"xlabel", "still frame"}, {"ylabel", "error"}}};
    }

    [[nodiscard]] Chart passes() const {
        return {.name = "passes-" + slug(scene_),
                .title = "Frame time by pass.",
                .text = "Milliseconds of a frame by pass; the figures are in the table below.",
                .kind = "bars",
                .table = "passes",
                .options = {{"unit", "ms"}}};
    }

    [[nodiscard]] Chart lod() const {
        return {.name = "lod-" + slug(scene_),
                .title = "Change of colour beyond lod-full's along the walk.",
                .text = "Change of colour and frame time along the walk, by technique; the figures are in the tables below.",
                .kind = "lines",
                .table = "walk",
                .options = {{"xlabel", "frame"}, {"ylabel", "change of colour beyond lod-full's"}}};
    }

private:
    const std::vector<Record>& records_;
    const std::string& scene_;
    const SiteWriter& site_;
};

/// One instance through its transition, by technique.
Data lodPictures(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images,
                 const SiteWriter& site) {
    Data list{Data::type::list};
    for (const std::size_t i : report::ofScene(records, scene)) {
        if (!isLevelOfDetail(records[i])) continue;
        if (const std::string address = picture(images, records[i], "transition", site); !address.empty())
            list << pictureData(address, truncate(records[i].variant), "");
    }
    return list;
}

} // namespace

void addScenePage(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images,
                  const std::vector<std::filesystem::path>& drawn, SiteWriter& site) {
    const std::string address = sceneAddress(scene);
    const SceneCharts charts(records, scene, site);
    Data data;
    data.set("scene", truncate(scene));
    data.set("described", truncate(describe(records, scene), sentenceRoom));
    setAnswer(data, records, choiceFor(records, scene), images, site);
    data.set("pareto", charts.place(drawn, costChart(records, scene, "errors")));
    data.set("errors", site.table(address, errorTable(records, scene, images)));
    const std::string metric = report::headlineMetric(records, scene);
    const metrics::MetricId errors =
        metric == "rmse" ? metrics::MetricId("stability.by_frame.rmse") : metrics::MetricId("stability.by_frame.mismatch");
    const auto frames = [&](const FrameList& list) { return site.table(address, frameTable(records, scene, list, images)); };
    data.set("convergencechart", charts.place(drawn, charts.convergence()));
    data.set("convergence", frames({errors, metric, "convergence", "Error by still frame, from an empty history"}));
    data.set("changed", frames({"stability.by_frame.changed", "mismatch", "changed",
                                "Pixels more than 30/255 off the technique's own last frame, by still frame"}));
    data.set("changedchart", charts.scripted("Pixels more than 30/255 off the technique's own last frame.", "changed",
                                             "still frame", "pixels off its last frame"));
    data.set("walk", frames({"lod.by_frame.walk_pop", "", "walk", "Change of colour beyond lod-full's, by frame"}));
    data.set("times", frames({"lod.by_frame.milliseconds", "", "times", "Milliseconds, by frame"}));
    data.set("timeschart", charts.scripted("Frame time along the walk.", "times", "frame", "ms"));
    data.set("passchart", charts.place(drawn, charts.passes()));
    data.set("passes", site.table(address, passTable(records, scene, images)));
    data.set("note", report::rasteriserNote(records, scene));
    data.set("lodchart", charts.place(drawn, charts.lod()));
    data.set("lod", site.table(address, tableOf(report::lodTable(records, scene), "lod", "Levels of detail")));
    data.set("lodpictures", lodPictures(records, scene, images, site));
    data.set("unscored", site.table(address, unscoredTable(records, scene)));
    for (const char* part : {"pareto", "errors", "convergence", "changed", "passes", "lod", "walk", "times", "unscored"})
        data.set(std::string("has") + part, !data.get(part)->string_value().empty());
    site.add({address, scene, render("scene.html", data)});
}

} // namespace shadowbench::site
