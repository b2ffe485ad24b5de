// The scores of other people's renderers.
#include "site/matrix.h"
#include "site/names.h"
#include "site/pages.h"

#include <algorithm>

namespace shadowbench::site {
namespace {

/// "external:three-pcf" → "three-pcf".
std::string rendererName(const std::string& variant) {
    return variant.starts_with(externalPrefix) ? variant.substr(externalPrefix.size()) : variant;
}

/// What each renderer says of itself, once.
Table rendererTable(const std::vector<Record>& records) {
    Table table{.id = "renderers", .caption = "What drew them", .rows = {}, .headed = false};
    table.columns = {{.title = "renderer", .number = false},
                     {.title = "what it draws", .number = false, .prose = true},
                     {.title = "version", .number = false, .prose = true}};
    std::vector<std::string> seen;
    for (const Record& record : records) {
        if (std::ranges::find(seen, record.variant) != seen.end()) continue;
        seen.push_back(record.variant);
        const ExternalInfo facts = record.external.value_or(ExternalInfo{});
        table.rows.push_back({{Cell{rendererName(record.variant)}, Cell{facts.title.empty() ? "–" : facts.title},
                               Cell{facts.source.empty() ? "–" : facts.source}},
                              {{"family", "external"}}});
    }
    return table;
}

/// Names without what marks them as other renderers' among techniques; no cost is known of any.
Table scoresOf(const std::vector<Record>& records, const std::filesystem::path& images) {
    Table table = matrixTable(records, images, "Every renderer on every scene");
    const auto cost = std::ranges::find(table.columns, "cost", &Column::key) - table.columns.begin();
    table.columns.erase(table.columns.begin() + cost);
    table.columns.front().title = "renderer";
    for (Row& row : table.rows) {
        row.cells.erase(row.cells.begin() + cost);
        row.cells.front().text = rendererName(row.cells.front().text);
    }
    return table;
}

} // namespace

void addEnginesPage(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site) {
    Data data;
    data.set("all", site.table(enginesAddress, scoresOf(records, images)));
    data.set("renderers", site.table(enginesAddress, rendererTable(records)));
    site.add({.address = enginesAddress,
              .title = "Engines",
              .main = render("engines.html", data),
              .description = "How correct the shadows of game engines and path tracers are, by the same exact references."});
}

} // namespace shadowbench::site
