#include "studies/behaviour/technique_page.h"

#include "base/files.h"
#include "report/listing.h"
#include "report/summary.h"
#include "studies/behaviour/behaviour.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <tuple>

namespace shadowbench {
namespace {

using report::markdownText;
using techniques::Answer;
using techniques::Entry;

constexpr const char* ruleOfShadows =
    "*By the error: of the scenes of the [published](../../results/published/report.md), the "
    "[failure](../../results/failures/report.md) and the [modern](../../results/README.md) sets those on which the error "
    "with all defaults has the least and the "
    "greatest ratio to that of `none` ([the rule](../techniques.md#pages-of-techniques)). A picture has visibility on its "
    "left, and on its right the error, too dark in red and too bright in blue.*\n";

constexpr const char* ruleOfLevels =
    "*By the error: of the scenes of the [published](../../results/published/report.md) set those on which the pop with all "
    "defaults has the least and the greatest ratio to that of `lod-switch` ([the "
    "rule](../techniques.md#pages-of-techniques)). A picture has one instance through its transition.*\n";

bool isLod(const Entry& entry) { return entry.answer == Answer::Colour; }

/// The technique that others are measured from.
const char* baseOf(const Entry& entry) { return isLod(entry) ? "lod-switch" : "none"; }

/// The main error of the technique's kind of answer, by its name for bounds.
std::string errorOf(const Entry& entry) {
    if (isLod(entry)) return "pop";
    const bool soft =
        entry.answer == Answer::Soft || entry.environment == techniques::EnvironmentAnswer::Only; // a share of the light
    return soft ? "rmse" : "mismatch";
}

/// The metric that the scene's table ranks the record by.
std::string rankedBy(const Record& record) {
    const std::optional<Headline> ranked = headline(record);
    return isLevelOfDetail(record) ? "pop" : ranked ? ranked->metric : "";
}

/// The default variant on a scene, beside the base.
struct Place {
    const Record* record;
    double error, base;
    [[nodiscard]] double ratio() const { return error / base; }
};

std::vector<Place> placesOf(const Entry& entry, const std::vector<Record>& records) {
    const std::string metric = errorOf(entry);
    std::vector<Place> places;
    for (const Record& record : records) {
        if (record.variant != entry.id || rankedBy(record) != metric) continue;
        const auto base = std::ranges::find_if(
            records, [&](const Record& other) { return other.variant == baseOf(entry) && other.scene == record.scene; });
        if (base == records.end()) continue;
        const std::optional<double> error = metrics::bounded(record.values, metric);
        const std::optional<double> without = metrics::bounded(base->values, metric);
        if (error && without && *without > 0) places.push_back({&record, *error, *without});
    }
    return places;
}

/// What the default variant's frames take on each scene, and the most that it holds.
std::string costOf(const Entry& entry, const std::vector<Record>& records) {
    std::vector<std::string> ratios;
    double bytes = 0;
    for (const Record& record : records) {
        if (record.variant != entry.id) continue;
        std::optional<double> ratio = record.values["lod.time.ratio"];
        if (const std::optional<report::FrameCost> frame = report::frameCost(record)) ratio = frame->ratio;
        if (ratio) ratios.push_back(fmt::format("{:.2f} on `{}`", *ratio, record.scene));
        bytes = std::max(bytes, record.values["cost.work.peak_bytes"].value_or(0));
    }
    if (ratios.empty()) return "* **Cost**: not timed on the scenes of these records\n";
    const char* unit = isLod(entry) ? "`lod-switch`" : "`sm-uniform`, the dearer of standing and in motion";
    const std::string memory = bytes > 0 ? fmt::format("; {:.1f} MiB at most", bytes / (1 << 20)) : "";
    return fmt::format("* **Cost** in frames of {}: {}{}\n", unit, fmt::join(ratios, ", "), memory);
}

std::string listed(const Entry& entry, const std::vector<Record>& records) {
    std::vector<std::string> variants;
    for (const std::string& parameters : entry.variants)
        variants.push_back(parameters.empty() ? fmt::format("`{}`", entry.id)
                                              : fmt::format("`{}:{}`", entry.id, parameters));
    std::string text = fmt::format("* **Source**: {}\n* **Answer**: {}\n", markdownText(techniques::citation(entry.source)),
                                   answerOf(entry));
    if (entry.temporal) text += "* **History**: a frame depends on those before it\n";
    if (!entry.lacks.empty()) text += fmt::format("* **Not for**: {}\n", namesOf(entry.lacks));
    if (!entry.computed.empty()) text += fmt::format("* **Computed**: {}\n", markdownText(entry.computed));
    text += fmt::format("* **Variants** of a run: {}\n", fmt::join(variants, ", "));
    return text + costOf(entry, records);
}

std::string parametersOf(const Entry& entry) {
    if (entry.parameters.empty()) return "It has no parameters.\n";
    std::string text = "| parameter | values | default | meaning | source |\n|:---|:---|:---|:---|:---|\n";
    for (const techniques::Parameter& p : entry.parameters)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, markdownText(techniques::describe(p.domain)),
                            markdownText(p.defaultValue), markdownText(p.meaning),
                            p.source.empty() ? "–" : markdownText(p.source));
    return text;
}

/// "Acne without bias: false_shadow … on grazing-light (sm-uniform:bias=none), asserted by `SmUniform.HasAcne…`."
std::string assertedOf(const Entry& entry, const Asserted Behaviour::*which, const std::vector<Record>& records) {
    const auto found = std::ranges::find(behaviours(), entry.id, &Behaviour::technique);
    if (found == behaviours().end()) return "";
    const std::vector<std::string> cells = cellsOf(entry.id, (*found).*which, records);
    return fmt::format("* **By the tests**: {}: {} on {}, asserted by `{}`\n", markdownText(cells[0]),
                       markdownText(cells[3]), markdownText(cells[2]), cells[1]);
}

/// The error there, and the picture where there is one.
std::string shown(const Entry& entry, const Place& place, const std::filesystem::path& picture,
                  const std::vector<Record>& records) {
    const Record& record = *place.record;
    const std::string metric = errorOf(entry);
    std::string text = fmt::format("`{}`, {} {}, {} of `{}`'s", record.scene, report::meaning(metric),
                                   report::formatValue(metric, place.error), report::percent(place.ratio()), baseOf(entry));
    const std::vector<report::Tolerance> limits = report::tolerances(records, record.scene);
    if (const std::optional<double> share = report::shareOfTolerance(record, limits))
        text += fmt::format("; {} the scene's tolerances", *share <= 1 ? "within" : "beyond");
    if (record.status == Status::ExpectedFailure) text += ". The scene says: " + markdownText(record.reason);
    text += "\n";
    if (!std::filesystem::exists(picture)) return text;
    return fmt::format("{}\n![{} on {}](../pictures/techniques/{})\n", text, entry.id, record.scene,
                       picture.filename().string());
}

} // namespace

std::string techniquePage(const Entry& entry, const std::vector<Record>& records, const std::filesystem::path& pictures) {
    const std::vector<Place> places = placesOf(entry, records);
    const auto good = std::ranges::min_element(places, {}, [](const Place& p) { return std::tuple(p.ratio(), -p.base); });
    const auto bad = std::ranges::max_element(places, {}, [](const Place& p) { return std::tuple(p.ratio(), p.base); });
    const bool helps = good != places.end() && good->ratio() < 1;
    const bool errs = bad != places.end() && bad->ratio() > 0 && (bad != good || !helps);
    const std::string unrecorded = "there is no record of it beside one of " + std::string(baseOf(entry)) + "\n";
    std::string text = fmt::format("# {}\n\n`{}`\n\n{}\n{}", markdownText(entry.title), entry.id, listed(entry, records),
                                   parametersOf(entry));
    text += "\n## Where it is good\n\n" + assertedOf(entry, &Behaviour::strength, records) + "* **By the error**: ";
    text += helps            ? shown(entry, *good, pictures / (entry.id + "-good.png"), records)
            : places.empty() ? unrecorded
                             : "on no scene of these records\n";
    text += "\n## Where it breaks\n\n" + assertedOf(entry, &Behaviour::failure, records) + "* **By the error**: ";
    text += errs             ? shown(entry, *bad, pictures / (entry.id + "-breaks.png"), records)
            : places.empty() ? unrecorded
                             : "on no other scene of these records\n";
    return fmt::format("{}\n{}", text, isLod(entry) ? ruleOfLevels : ruleOfShadows);
}

void writeTechniquePages(const std::vector<Record>& records, const std::filesystem::path& folder) {
    for (const Entry& entry : techniques::catalog())
        writeFile(folder / (entry.id + ".md"), techniquePage(entry, records, folder / "../pictures/techniques"));
}

} // namespace shadowbench
