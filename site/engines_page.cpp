// The scores of other people's renderers.
#include "site/matrix.h"
#include "site/names.h"
#include "site/pages.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <sstream>

namespace shadowbench::site {
namespace {

/// "external:three-pcf" → "three-pcf".
std::string rendererName(const std::string& variant) {
    return variant.starts_with(externalPrefix) ? variant.substr(externalPrefix.size()) : variant;
}

/// "Blender 3.4, Cycles on the CPU" → "Blender": what stands before its version; a renderer that does not say what drew it
/// is an engine by itself.
std::string engineOf(const Record& record) {
    std::istringstream words(record.external.value_or(ExternalInfo{}).source);
    std::string name;
    for (std::string word; words >> word;) {
        if (std::ranges::any_of(word, [](unsigned char c) { return std::isdigit(c) != 0; })) break;
        name += (name.empty() ? "" : " ") + word;
    }
    while (name.ends_with(',')) name.pop_back();
    return name.empty() ? rendererName(record.variant) : name;
}

/// By variant: one record of it that says what drew it is enough, for those of errors do not.
std::map<std::string, std::string> enginesOf(const std::vector<Record>& records) {
    std::map<std::string, std::string> engines;
    for (const Record& record : records) {
        const bool says = record.external && !record.external->source.empty();
        if (says || !engines.contains(record.variant)) engines[record.variant] = engineOf(record);
    }
    return engines;
}

std::string engineAddress(const std::string& engine) { return "engines/" + slug(engine) + ".html"; }

std::string settingsOf(const Record& record) {
    std::vector<std::string> texts;
    for (const auto& [key, value] : record.parameters)
        if (key != "means") texts.push_back(fmt::format("{} = {}", key, value));
    return texts.empty() ? "–" : fmt::format("{}", fmt::join(texts, ", "));
}

/// What each renderer says of itself, once, and how it is called again.
Table rendererTable(const std::vector<Record>& records) {
    Table table{.id = "renderers", .caption = "What drew them", .rows = {}, .headed = false};
    table.columns = {
        {.title = "renderer", .number = false},
        {.title = "what it draws", .number = false, .prose = true},
        {.title = "version", .number = false, .prose = true},
        {.title = "settings", .number = false, .prose = true},
        {.title = "again", .hint = "LIST is the file that describes the renderer", .number = false, .prose = true}};
    const std::map<std::string, std::string> engines = enginesOf(records);
    std::vector<std::string> seen;
    for (const Record& record : records) {
        if (std::ranges::find(seen, record.variant) != seen.end()) continue;
        seen.push_back(record.variant);
        const ExternalInfo facts = record.external.value_or(ExternalInfo{});
        table.rows.push_back(
            {{Cell{.text = rendererName(record.variant), .address = engineAddress(engines.at(record.variant))},
              Cell{facts.title.empty() ? "–" : facts.title}, Cell{facts.source.empty() ? "–" : facts.source},
              Cell{settingsOf(record)},
              Cell{fmt::format("shadowbench run --external LIST --technique {} --scene {} --cost none", record.variant,
                               record.scene)}},
             {{"family", "external"}}});
    }
    return table;
}

/// Rows that give the same pixels as another one on three scenes or more.
Table sameImages(const std::vector<Record>& records) {
    std::map<std::string, std::map<std::string, std::string>> images; // variant → scene → hash
    for (const Record& record : records)
        if (wasScored(record.status) && !record.images.empty()) images[record.variant][record.scene] = record.images;
    Table table{.id = "same", .caption = "Rows with the same images", .rows = {}, .headed = false};
    table.columns = {{.title = "renderer", .number = false},
                     {.title = "and", .number = false},
                     {.title = "scenes"},
                     {.title = "of", .hint = "scenes that both have scored"}};
    for (auto one = images.begin(); one != images.end(); ++one)
        for (auto other = std::next(one); other != images.end(); ++other) {
            int both = 0, same = 0;
            for (const auto& [scene, hash] : one->second)
                if (const auto found = other->second.find(scene); found != other->second.end()) {
                    ++both;
                    same += found->second == hash ? 1 : 0;
                }
            if (same < 3) continue;
            table.rows.push_back({{Cell{rendererName(one->first)}, Cell{rendererName(other->first)},
                                   Cell{fmt::format("{}", same), static_cast<double>(same)},
                                   Cell{fmt::format("{}", both), static_cast<double>(both)}},
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
    const Table same = sameImages(records);
    data.set("all", site.table(enginesAddress, scoresOf(records, images)));
    data.set("renderers", site.table(enginesAddress, rendererTable(records)));
    data.set("hassame", !same.rows.empty());
    data.set("same", same.rows.empty() ? "" : site.table(enginesAddress, same));
    site.add({.address = enginesAddress,
              .title = "Engines",
              .main = render("engines.html", data),
              .description = "How correct the shadows of game engines and path tracers are, by the same exact references."});
    const std::map<std::string, std::string> names = enginesOf(records);
    std::map<std::string, std::vector<Record>> engines;
    for (const Record& record : records) engines[names.at(record.variant)].push_back(record);
    for (const auto& [engine, of] : engines) {
        const std::string address = engineAddress(engine);
        Data page;
        page.set("engine", engine);
        page.set("all", site.table(address, scoresOf(of, images)));
        page.set("renderers", site.table(address, rendererTable(of)));
        site.add({.address = address,
                  .title = engine,
                  .main = render("engine.html", page),
                  .description = "How correct the shadows of " + engine + " are, row by row and scene by scene."});
    }
}

} // namespace shadowbench::site
