// Which technique to take on which scene, and every technique on every scene.
#include "report/costing.h"
#include "report/summary.h"
#include "site/choice.h"
#include "site/matrix.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/scene_tables.h"
#include "site/ship.h"
#include "site/technique_facts.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

Cell costCell(const std::optional<report::FrameCost>& cost) {
    return cost ? Cell{fmt::format("{:.2f}", cost->ratio), cost->ratio} : Cell{"–"};
}

std::string shortList(const std::vector<Record>& records, const std::vector<std::size_t>& indices) {
    constexpr std::size_t most = 2;
    std::string text;
    for (std::size_t i = 0; i < std::min(indices.size(), most); ++i)
        text += (i == 0 ? "" : ", ") + records[indices[i]].variant;
    return indices.size() > most ? fmt::format("{} and {} more", text, indices.size() - most) : text.empty() ? "–" : text;
}

/// "cheapest of 10 within tolerance; then volume-zpass, volume-zfail and 7 more".
std::string reason(const std::vector<Record>& records, const Choice& choice) {
    return choice.others.empty() ? choice.why : fmt::format("{}; then {}", choice.why, shortList(records, choice.others));
}

Row answerRow(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images) {
    const Choice choice = choiceFor(records, scene);
    Row row{{{.text = scene, .address = sceneAddress(scene)}}};
    if (!choice.take) {
        row.cells.resize(7, Cell{"–"});
        row.cells.push_back({choice.why});
        return row;
    }
    const Record& taken = records[*choice.take];
    Cell take = techniqueCell(taken, images);
    if (take.address.empty()) take.address = sceneAddress(scene);
    take.small = take.name == take.text ? "" : take.text;
    take.text = take.name;
    take.kind = choice.adequate ? "take" : "nearest";
    const std::optional<double> share = report::shareOfTolerance(taken, report::tolerances(records, scene));
    row.cells.push_back(take);
    row.cells.push_back({errorText(taken), headline(taken)->value});
    row.cells.push_back(share ? Cell{fmt::format("{:.2f}", *share), *share, {}, *share <= 1 ? "within" : ""} : Cell{"–"});
    const report::Costing costing = report::shownCosting(records, scene);
    row.cells.push_back(costing.card.empty() ? Cell{"–"} : costCell(costing.of(taken)));
    row.cells.push_back(costCell(report::frameCost(taken)));
    row.cells.push_back({.text = report::admittedFailure(taken.technique), .kind = "small"});
    row.cells.push_back({.text = reason(records, choice), .kind = "small"});
    return row;
}

Table answers(const std::vector<Record>& records, const std::filesystem::path& images) {
    Table table{.id = "answers", .caption = "The technique to take on each scene", .headed = false};
    table.columns = {
        {.title = "scene", .number = false},
        {.title = "take", .number = false},
        {.title = "error",
         .hint = "Share of receiver pixels with the wrong label (per cent), or rms error of visibility under an area light"},
        {.title = "× tolerance", .hint = "Its error nearest to a tolerance of the scene, as a multiple of it"},
        {.title = "modelled ms",
         .hint = "Milliseconds of a frame on the graphics card that the scene's page names, modelled and not measured"},
        {.title = "cost", .hint = "Frame time as a multiple of sm-uniform's: the dearer of standing and in motion"},
        {.title = "its weakness", .number = false, .brief = false, .prose = true},
        {.title = "why", .number = false, .brief = false, .prose = true}};
    for (const std::string& scene : report::scenes(records)) table.rows.push_back(answerRow(records, scene, images));
    return table;
}

/// The row of least error at each cost, in frames of sm-uniform; without rows where no scene has such a frame's cost.
Table budgets(const std::vector<Record>& records, const std::filesystem::path& images) {
    static constexpr double factors[] = {1, 1.25, 1.5, 2, 4, 8};
    Table table{.id = "budgets",
                .caption = "The least error for a cost, in frames of sm-uniform",
                .columns = {{.title = "scene", .number = false}},
                .rows = {},
                .headed = false};
    for (const double factor : factors) table.columns.push_back({.title = fmt::format("{:g} ×", factor), .number = false});
    for (const std::string& scene : report::scenes(records)) {
        const report::CostOf costOf = report::shownCosting(records, scene).of;
        std::vector<std::size_t> rows = suitedOn(records, scene);
        std::ranges::stable_sort(rows, {}, [&](std::size_t i) { return headline(records[i])->value; });
        const auto base = std::ranges::find(rows, "sm-uniform", [&](std::size_t i) { return records[i].variant; });
        const auto unit = base == rows.end() ? std::nullopt : costOf(records[*base]);
        if (!unit) continue;
        Row& row = table.rows.emplace_back(Row{{{.text = scene, .address = sceneAddress(scene)}}, {}});
        for (const double factor : factors) {
            const auto best = std::ranges::find_if(rows, [&](std::size_t i) {
                const auto cost = costOf(records[i]);
                return cost && cost->ratio <= factor * unit->ratio;
            });
            Cell cell = techniqueCell(records[*best], images); // sm-uniform itself, where nothing is better
            cell.small = errorText(records[*best]);
            row.cells.push_back(std::move(cell));
        }
    }
    return table;
}

} // namespace

void addChoosePage(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site) {
    Data data;
    data.set("empty", records.empty());
    data.set("ship", site.table(chooseAddress, shipTable(records, images)));
    data.set("hasship", !data.get("ship")->string_value().empty());
    data.set("answers", site.table(chooseAddress, answers(records, images)));
    data.set("budgets", site.table(chooseAddress, budgets(records, images)));
    data.set("hasbudgets", !data.get("budgets")->string_value().empty());
    data.set("all", site.table(chooseAddress, matrixTable(records, images, "Every technique on every scene")));
    site.add({.address = chooseAddress,
              .title = "Choose a technique",
              .main = render("choose.html", data),
              .description = "Which shadow technique to take on which scene: the cheapest whose errors a viewer accepts."});
}

} // namespace shadowbench::site
