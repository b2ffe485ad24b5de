// The first page: which technique to take on which scene.
#include "report/run_report.h"
#include "report/run_text.h"
#include "report/summary.h"
#include "site/choice.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/scene_tables.h"
#include "site/technique_facts.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

constexpr const char* indexAddress = "index.html";

Cell costCell(const Record& record) {
    const std::optional<report::FrameCost> cost = report::frameCost(record);
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

/// "Projected shadow on a plane; its weakness: shades nothing but its plane": what does here may not do elsewhere.
std::string portrait(const std::string& technique) {
    const std::string weakness = report::admittedFailure(technique), title = factsOf(technique).title;
    return weakness.empty() ? title : fmt::format("{}. Its weakness: {}", title, weakness);
}

Row answerRow(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images) {
    const Choice choice = choiceFor(records, scene);
    Row row{{{.text = scene, .address = sceneAddress(scene)}}};
    if (!choice.take) {
        row.cells.resize(6, Cell{"–"});
        row.cells.push_back({choice.why});
        return row;
    }
    const Record& taken = records[*choice.take];
    Cell take = techniqueCell(taken, images);
    if (take.address.empty()) take.address = sceneAddress(scene);
    take.kind = choice.adequate ? "take" : "nearest";
    const std::optional<double> share = report::shareOfTolerance(taken, report::tolerances(records, scene));
    row.cells.push_back(take);
    row.cells.push_back({errorText(taken), headline(taken)->value});
    row.cells.push_back(share ? Cell{fmt::format("{:.2f}", *share), *share, {}, *share <= 1 ? "within" : ""} : Cell{"–"});
    row.cells.push_back(costCell(taken));
    row.cells.push_back({.text = portrait(taken.technique), .kind = "small"});
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
        {.title = "cost", .hint = "Frame time as a multiple of sm-uniform's: the dearer of standing and in motion"},
        {.title = "what it is", .number = false, .brief = false, .prose = true},
        {.title = "why", .number = false, .brief = false, .prose = true}};
    for (const std::string& scene : report::scenes(records)) table.rows.push_back(answerRow(records, scene, images));
    return table;
}

/// How far beyond the tolerance, in steps that the style has colours for.
std::string heat(const std::optional<double>& share) {
    if (!share) return "";
    return *share <= 1 ? "h0" : *share <= 2 ? "h1" : *share <= 5 ? "h2" : *share <= 20 ? "h3" : "h4";
}

Cell matrixCell(const std::vector<Record>& records, std::size_t index, const std::filesystem::path& images) {
    const Record& record = records[index];
    if (!headline(record)) return {.text = record.status == Status::Error ? "error" : "–", .note = record.reason};
    const std::optional<double> share = report::shareOfTolerance(record, report::tolerances(records, record.scene));
    Cell cell{.text = errorText(record), .value = share ? *share : headline(record)->value, .kind = heat(share)};
    if (share) cell.note = fmt::format("{:.2f} × the tolerance", *share);
    if (hasCell(record, images)) cell.address = cellAddress(record);
    return cell;
}

/// Rows of the table of all techniques on all scenes.
class Matrix {
public:
    Matrix(const std::vector<Record>& records, const std::filesystem::path& images)
        : records_(records), images_(images), scenes_(report::scenes(records)) {}

    [[nodiscard]] Table table() const {
        Table table{.id = "all",
                    .caption = "Every technique on every scene",
                    .columns = {},
                    .rows = {},
                    .filtered = true,
                    .headed = false};
        table.columns = {
            {.title = "technique", .number = false},
            {.title = "within", .hint = "Number of scenes on which it is within tolerance", .key = "within"},
            {.title = "cost",
             .hint = "Frame time as a multiple of sm-uniform's, the dearer of standing and in motion: geometric mean over "
                     "the scenes",
             .key = "cost"}};
        for (const std::string& scene : scenes_)
            table.columns.push_back({.title = truncate(scene),
                                     .hint = "Error; sorted by its multiple of the tolerance",
                                     .key = truncate(scene)});
        std::vector<std::string> variants;
        for (const Record& record : records_)
            if (!isLevelOfDetail(record) && std::ranges::find(variants, record.variant) == variants.end())
                variants.push_back(record.variant);
        for (const std::string& variant : variants)
            if (Row row = rowOf(variant); !row.cells.empty()) table.rows.push_back(std::move(row));
        table.scale = {{"h0", "within the scene's tolerance"},
                       {"h1", "up to 2 times it"},
                       {"h2", "up to 5"},
                       {"h3", "up to 20"},
                       {"h4", "beyond"}};
        table.note = "– does not apply.";
        return table;
    }

private:
    /// The record of a variant on each scene; the first of several.
    [[nodiscard]] std::vector<std::optional<std::size_t>> cellsOf(const std::string& variant) const {
        std::vector<std::optional<std::size_t>> cells(scenes_.size());
        for (std::size_t i = 0; i < records_.size(); ++i) {
            if (records_[i].variant != variant) continue;
            auto& cell = cells[static_cast<std::size_t>(std::ranges::find(scenes_, records_[i].scene) - scenes_.begin())];
            if (!cell) cell = i;
        }
        return cells;
    }

    [[nodiscard]] Row rowOf(const std::string& variant) const {
        Row row;
        int within = 0, timed = 0;
        double logCost = 0;
        bool scored = false;
        std::vector<Cell> cells;
        const Record* first = nullptr;
        for (const std::optional<std::size_t>& index : cellsOf(variant)) {
            cells.push_back(index ? matrixCell(records_, *index, images_) : Cell{"–"});
            if (!index) continue;
            const Record& record = records_[*index];
            if (first == nullptr) first = &record;
            scored = scored || headline(record);
            within += report::isWithin(record, report::tolerances(records_, record.scene)) ? 1 : 0;
            if (const std::optional<report::FrameCost> cost = report::frameCost(record); cost && cost->ratio > 0) {
                logCost += std::log(cost->ratio);
                ++timed;
            }
        }
        if (!scored) return row;
        const TechniqueFacts facts = factsOf(first->technique);
        const double cost = timed > 0 ? std::exp(logCost / timed) : 0;
        row.cells = {Cell{.text = variant, .note = techniqueCell(*first, {}).note},
                     Cell{std::to_string(within), static_cast<double>(within)},
                     timed > 0 ? Cell{fmt::format("{:.2f}", cost), cost} : Cell{"–"}};
        row.cells.insert(row.cells.end(), cells.begin(), cells.end());
        row.marks = {{"family", facts.family},
                     {"answer", facts.answer},
                     {"within", within > 0 ? "yes" : "no"},
                     {"baseline", report::isBaseline(*first) ? "yes" : "no"}};
        return row;
    }

    const std::vector<Record>& records_;
    const std::filesystem::path& images_;
    std::vector<std::string> scenes_;
};

std::size_t countVariants(const std::vector<Record>& records) {
    std::vector<std::string> variants;
    for (const Record& record : records)
        if (std::ranges::find(variants, record.variant) == variants.end()) variants.push_back(record.variant);
    return variants.size();
}

std::string lead(const std::vector<Record>& records) {
    if (records.empty()) return "There are no records.";
    const std::size_t scenes = report::scenes(records).size(), variants = countVariants(records);
    return fmt::format("{} technique{} on {} scene{}, scored against exact truth. Take the cheapest that stays within what "
                       "a viewer of the scene accepts.",
                       variants, variants == 1 ? "" : "s", scenes, scenes == 1 ? "" : "s");
}

} // namespace

void addIndexPage(const std::vector<Record>& records, const std::string& command, const std::filesystem::path& images,
                  SiteWriter& site) {
    Data data;
    data.set("lead", lead(records));
    data.set("answers", site.table(indexAddress, answers(records, images)));
    data.set("all", site.table(indexAddress, Matrix(records, images).table()));
    data.set("measured", !records.empty());
    data.set("commit", truncate(report::commitsOf(records)));
    data.set("environment", truncate(report::environmentsOf(records)));
    constexpr std::size_t longestCommand = 8000; // bytes; one that is longer is no use to a reader
    data.set("command", command.size() > longestCommand ? truncate(command) : command);
    data.set("data", std::filesystem::exists(site.folder() / "results.jsonl"));
    data.set("time", records.empty() ? "" : truncate(records.front().time));
    data.set("profile", records.empty() ? "" : truncate(records.front().profile));
    site.add({indexAddress, "Which shadow technique?", render("index.html", data)});
}

} // namespace shadowbench::site
