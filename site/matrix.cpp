// Every variant on every scene, in one table.
#include "site/matrix.h"

#include "report/run_report.h"
#include "report/summary.h"
#include "site/choice.h"
#include "site/multiples.h"
#include "site/names.h"
#include "site/scene_tables.h"
#include "site/technique_facts.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

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
    Matrix(const std::vector<Record>& records, const std::filesystem::path& images, std::string caption)
        : records_(records), images_(images), caption_(std::move(caption)), scenes_(report::scenes(records)),
          costs_(records) {}

    [[nodiscard]] Table table() const {
        Table table{.id = "all", .caption = caption_, .columns = {}, .rows = {}, .filtered = true, .headed = false};
        table.columns = {{.title = "technique", .number = false},
                         {.title = "within", .hint = "Number of scenes on which it is within tolerance", .key = "within"},
                         {.title = "cost",
                          .hint = "Frame time as a multiple of sm-uniform's, the dearer of standing and in motion, " +
                                  costs_.where() + ": geometric mean over the scenes that have one",
                          .key = "cost"}};
        for (const std::string& scene : scenes_)
            table.columns.push_back({.title = truncate(scene),
                                     .hint = "Error; sorted by its multiple of the tolerance",
                                     .key = truncate(scene),
                                     .least = true});
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
        int within = 0;
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
        }
        if (!scored) return row;
        const TechniqueFacts facts = factsOf(first->technique);
        const std::optional<double> cost = costs_.mean(variant, scenes_);
        row.cells = {Cell{.text = variant, .name = report::nameForPeople(*first), .note = techniqueCell(*first, {}).note},
                     Cell{std::to_string(within), static_cast<double>(within)},
                     cost ? Cell{fmt::format("{:.2f}", *cost), *cost} : Cell{"–"}};
        row.cells.insert(row.cells.end(), cells.begin(), cells.end());
        row.marks = {{"family", facts.family},
                     {"answer", facts.answer},
                     {"within", within > 0 ? "yes" : "no"},
                     {"baseline", report::isBaseline(*first) ? "yes" : "no"}};
        return row;
    }

    const std::vector<Record>& records_;
    const std::filesystem::path& images_;
    std::string caption_;
    std::vector<std::string> scenes_;
    Multiples costs_;
};

} // namespace

Table matrixTable(const std::vector<Record>& records, const std::filesystem::path& images, const std::string& caption) {
    return Matrix(records, images, caption).table();
}

} // namespace shadowbench::site
