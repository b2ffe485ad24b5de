// The first page: what this is, what it looks like, and the ways in.
#include "report/families.h"
#include "report/run_report.h"
#include "report/run_text.h"
#include "report/slug.h"
#include "report/summary.h"
#include "site/choice.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/scene_tables.h"
#include "site/technique_facts.h"
#include "site/viewer/cells.h"
#include "site/viewer/thumbnail.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace shadowbench::site {
namespace {

constexpr const char* indexAddress = "index.html";

std::string counted(std::size_t count, const std::string& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// "57 techniques in 134 variants on 37 scenes": of techniques alone; other renderers are settings of engines.
std::string countsOf(const Contents& contents) {
    std::set<std::string> techniques, variants, engines;
    for (const Record& record : contents.records) {
        if (isExternal(record)) {
            engines.insert(record.variant);
            continue;
        }
        techniques.insert(record.technique);
        variants.insert(record.variant);
    }
    std::string text = fmt::format("{} in {} on {}", counted(techniques.size(), "technique"),
                                   counted(variants.size(), "variant"), counted(contents.scenes, "scene"));
    if (!engines.empty()) text += fmt::format("; beside them {} of other renderers", counted(engines.size(), "setting"));
    return text + ".";
}

/// The scene on which most was timed; "" where nothing was.
std::string chartedScene(const std::vector<Record>& records) {
    std::map<std::string, int> timed;
    for (const Record& record : records)
        if (report::place(record)) ++timed[record.scene];
    std::string best;
    for (const std::string& scene : report::scenes(records))
        if (timed.contains(scene) && (best.empty() || timed[scene] > timed[best])) best = scene;
    return best;
}

/// Error and cost of every technique on the scene, which its chart is drawn from.
Table exampleTable(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images) {
    const std::string metric = report::headlineMetric(records, scene);
    Table table{.id = "example",
                .caption = "Error and cost on " + scene,
                .columns = {{.title = "technique", .number = false},
                            {.title = "error",
                             .hint = report::meaning(metric),
                             .key = "error",
                             .unit = report::isShare(metric) ? "share" : "1"},
                            {.title = "cost", .hint = report::costMeaning(records, scene), .key = "cost"}},
                .rows = {}};
    const report::Costing costing = report::shownCosting(records, scene);
    if (!costing.card.empty()) table.columns.push_back(modelledColumn(costing));
    for (const std::size_t i : report::scoredOf(records, scene)) {
        const std::optional<report::Place> place = report::place(records[i]);
        if (!place) continue;
        table.rows.push_back({{techniqueCell(records[i], images), Cell{errorText(records[i]), place->error},
                               Cell{fmt::format("{:.2f}", place->cost), place->cost}},
                              marksOf(records, i)});
        if (!costing.card.empty()) table.rows.back().cells.push_back(modelledCell(records[i], costing));
    }
    return table;
}

/// The chart of one scene, and its figures.
void setChart(Data& data, const Contents& contents, SiteWriter& site) {
    const std::string scene = chartedScene(contents.records);
    const Chart chart = costChart(contents.records, scene, "example");
    const bool drawn = !scene.empty() && std::filesystem::exists(site.folder() / (chart.name + ".svg"));
    data.set("charted", drawn);
    if (!drawn) return;
    data.set("chart", site.chart(indexAddress, chart));
    data.set("example", site.table(indexAddress, exampleTable(contents.records, scene, contents.images)));
    data.set("chartscene", truncate(scene));
    data.set("chartpage", sceneAddress(scene));
}

/// Indices of the records of which there are pictures, those of the scene with most techniques first.
std::vector<std::size_t> pictured(const Contents& contents) {
    std::map<std::string, std::set<std::string>> techniques;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < contents.records.size(); ++i) {
        const Record& record = contents.records[i];
        if (isExternal(record) || !(hasCell(record, contents.images) || isLevelOfDetail(record))) continue;
        found.push_back(i);
        techniques[record.scene].insert(record.technique);
    }
    std::ranges::stable_sort(found, std::greater(),
                             [&](std::size_t i) { return techniques[contents.records[i].scene].size(); });
    return found;
}

/// Truth, technique and error of the plainest technique there.
void setPictures(Data& data, const Contents& contents, SiteWriter& site) {
    Data list{Data::type::list};
    std::vector<std::size_t> cells = pictured(contents);
    std::erase_if(cells, [&](std::size_t i) {
        return !hasCell(contents.records[i], contents.images) || report::isBaseline(contents.records[i]);
    });
    const auto plainest = std::ranges::find_if(cells, [&](std::size_t i) {
        return contents.records[i].variant == "sm-uniform" &&
               contents.records[i].scene == contents.records[cells.front()].scene;
    });
    if (!cells.empty()) {
        const Record& record = contents.records[plainest == cells.end() ? cells.front() : *plainest];
        const std::string title = factsOf(record.technique).title;
        if (const auto pictures = cellPictures({record.variant, record, contents.images}, contents.images, site)) {
            for (const auto& [source, caption] :
                 {std::pair(pictures->truth,
                            fmt::format("The truth: how much of the light each pixel of {} sees", record.scene)),
                  std::pair(pictures->technique, fmt::format("What it gets: {} ({})", title, record.variant)),
                  std::pair(pictures->difference,
                            fmt::format("The error, {}: orange too dark, blue too bright", errorText(record)))}) {
                Data entry;
                entry.set("source", source);
                entry.set("caption", truncate(caption));
                entry.set("to", cellAddress(record));
                list << entry;
            }
            writeCard(record, contents.images, site);
        }
    }
    data.set("pictured", list.is_non_empty_list());
    data.set("pictures", list);
}

/// Where a technique's card leads: to its pixels, else to its scene.
Data techniqueCard(const Record& record, const std::string& picture, const std::filesystem::path& images) {
    Data data;
    data.set("title", truncate(factsOf(record.technique).title));
    data.set("id", truncate(record.technique));
    data.set("to", hasCell(record, images) ? cellAddress(record) : sceneAddress(record.scene));
    data.set("pictured", !picture.empty());
    data.set("picture", picture);
    data.set("scene", truncate(record.scene));
    return data;
}

/// Every technique once, by family; `pictures`: the record of each that there is a picture of.
Data familyCards(const Contents& contents, const SiteWriter& site) {
    std::map<std::string, std::size_t> shown; // by technique
    for (const std::size_t i : pictured(contents)) shown.try_emplace(contents.records[i].technique, i);
    std::vector<std::size_t> firsts;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < contents.records.size(); ++i)
        if (const Record& record = contents.records[i]; !isExternal(record) && seen.insert(record.technique).second)
            firsts.push_back(i);
    Data list{Data::type::list};
    for (const report::Family& family : report::families()) {
        Data entry, cards{Data::type::list};
        std::size_t count = 0;
        for (const std::size_t first : firsts) {
            const std::string& technique = contents.records[first].technique;
            if (report::familyOf(technique).id != std::string_view(family.id)) continue;
            const Record& record = contents.records[shown.contains(technique) ? shown.at(technique) : first];
            cards << techniqueCard(record, thumbnail(record, contents.images, site), contents.images);
            ++count;
        }
        if (count == 0) continue;
        entry.set("family", family.id);
        entry.set("title", family.title);
        entry.set("count", std::to_string(count));
        entry.set("cards", cards);
        list << entry;
    }
    return list;
}

Data wayIn(const std::string& title, const std::string& says, const std::string& to) {
    Data data;
    data.set("title", title);
    data.set("says", says);
    data.set("address", to);
    return data;
}

Data waysIn(const Contents& contents) {
    Data list{Data::type::list};
    list << wayIn("Choose a technique", "The cheapest for each scene whose errors a viewer accepts, and all the others.",
                  chooseAddress);
    if (contents.engines)
        list << wayIn("Look at engines", "Engines and path tracers on the same scenes, by the same truth.", enginesAddress);
    if (contents.claims > 0)
        list << wayIn("Read the claims",
                      fmt::format("{} of the papers, and what the records say of each.", counted(contents.claims, "claim")),
                      "claims.html");
    return list;
}

} // namespace

void addIndexPage(const Contents& contents, SiteWriter& site) {
    const std::vector<Record>& records = contents.records;
    Data data;
    data.set("empty", records.empty());
    data.set("counts", countsOf(contents));
    setChart(data, contents, site);
    setPictures(data, contents, site);
    data.set("ways", waysIn(contents));
    data.set("families", familyCards(contents, site));
    data.set("measured", !records.empty());
    data.set("commit", truncate(report::commitsOf(records)));
    data.set("environment", truncate(report::environmentsOf(records)));
    constexpr std::size_t longestCommand = 8000; // bytes; one that is longer is no use to a reader
    data.set("command", contents.command.size() > longestCommand ? truncate(contents.command) : contents.command);
    data.set("data", std::filesystem::exists(site.folder() / "results.jsonl"));
    data.set("time", records.empty() ? "" : truncate(records.front().time));
    data.set("profile", records.empty() ? "" : truncate(records.front().profile));
    site.add({.address = indexAddress,
              .title = "How correct are real-time shadows?",
              .main = render("index.html", data),
              .description = "Real-time shadow techniques against exact truth: " + countsOf(contents)});
}

} // namespace shadowbench::site
