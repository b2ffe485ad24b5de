// Pages as JSON.
#include "studies/papers/papers.h"

#include "base/error.h"
#include "base/json_text.h"
#include "embedded_papers.h"
#include "studies/json_members.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

PaperColumn parseColumn(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"title", "scene", "profile", "metric", "per"});
    return {members.text("title"), members.text("scene"), members.text("profile"), members.text("metric"),
            members.has("per") ? members.text("per") : ""};
}

/// A row has a published number or null for every column.
PaperRow parseRow(const Json& json, std::size_t columns, const std::string& what) {
    const JsonMembers members(json, what, {"title", "variant", "published"});
    PaperRow row{members.text("title"), members.text("variant"), {}};
    for (const Json& number : members.list("published")) {
        if (!number.is_number() && !number.is_null()) refuseJson(what, "\"published\" must list numbers, or null for none");
        row.published.push_back(number.is_null() ? std::nullopt : std::optional(number.get<double>()));
    }
    if (row.published.size() != columns)
        refuseJson(what,
                   fmt::format("the row \"{}\" has {} numbers for {} columns", row.title, row.published.size(), columns));
    return row;
}

PaperTable parseTable(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"columns", "rows"});
    PaperTable table;
    for (const Json& column : members.list("columns")) table.columns.push_back(parseColumn(column, what));
    for (const Json& row : members.list("rows")) table.rows.push_back(parseRow(row, table.columns.size(), what));
    return table;
}

PaperChart parseChart(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"title", "scene", "variants"});
    return {members.text("title"), members.text("scene"), members.texts("variants")};
}

PaperPage parsePage(const Json& json) {
    const bool named = json.is_object() && json.contains("id") && json["id"].is_string();
    const std::string what = "papers: " + (named ? json["id"].get<std::string>() : "a page without id");
    const JsonMembers members(json, what, {"id", "title", "where", "says", "table", "charts"});
    PaperPage page{members.text("id"), members.text("title"), members.text("where"), members.text("says"), {}, {}};
    if (members.has("table")) page.table = parseTable(members.get("table"), what);
    if (members.has("charts"))
        for (const Json& chart : members.list("charts")) page.charts.push_back(parseChart(chart, what));
    return page;
}

} // namespace

const std::vector<PaperPage>& paperPages() {
    static const std::vector<PaperPage> all = parsePaperPages(embedded::papers().front().text);
    return all;
}

std::vector<PaperPage> parsePaperPages(std::string_view json) {
    const Json list = Json::parse(boundedJson(json, "reading pages"), nullptr, false);
    if (!list.is_array()) throw BadInput("reading papers: not a JSON list");
    std::vector<PaperPage> pages;
    for (const Json& page : list) pages.push_back(parsePage(page));
    return pages;
}

} // namespace shadowbench
