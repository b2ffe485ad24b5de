#include "harness/report/text_table.h"
#include "harness/studies/causes/causes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench::causes {
namespace {

using nlohmann::ordered_json;

std::string errorText(const Explanation& row) {
    return row.metric == "mismatch" ? fmt::format("{:.3g} %", 100 * row.error) : fmt::format("{:.3g}", row.error);
}

std::string legend() {
    std::vector<std::string> colours;
    for (const CauseWords& cause : allCauses()) colours.push_back(fmt::format("{} {}", cause.colourName, cause.name));
    const auto half = colours.begin() + static_cast<std::ptrdiff_t>(colours.size() / 2);
    return fmt::format("pictures: grey right, {},\n {}", fmt::join(colours.begin(), half, ", "),
                       fmt::join(half, colours.end(), ", "));
}

std::string metricsOf(const SceneCauses& scene) {
    const auto has = [&](std::string_view metric) {
        return std::ranges::any_of(scene.rows, [&](const Explanation& row) { return row.metric == metric; });
    };
    std::vector<std::string> words;
    if (has("mismatch")) words.emplace_back("mismatch in % of receivers");
    if (has("mae")) words.emplace_back("mae of soft rows");
    return fmt::format("{}", fmt::join(words, ", "));
}

report::TextTable tableOf(const SceneCauses& scene, bool linked) {
    report::TextTable table{{"row", "error", "causes, in % of the error", "change first"}, {}};
    for (const Explanation& row : scene.rows) {
        const std::string name =
            linked && !row.isRight() ? fmt::format("[{}]({})", row.variant, pictureOf(row).string()) : row.variant;
        table.rows.push_back({name, errorText(row), sharesText(row), row.isRight() ? "–" : row.change});
    }
    return table;
}

std::string notesOf(const SceneCauses& scene) {
    std::string lines;
    for (const auto& [variant, reason] : scene.withoutAnswer) lines += fmt::format(" {}: {}\n", variant, reason);
    for (const auto& [variant, reason] : scene.errors) lines += fmt::format(" {}: failed: {}\n", variant, reason);
    return lines;
}

ordered_json toJson(const Explanation& row) {
    ordered_json result{{"variant", row.variant}, {"metric", row.metric}, {"error", row.error}};
    result["causes"] = ordered_json::object();
    for (const auto& [cause, error] : row.parts) result["causes"][std::string(name(cause))] = error;
    if (!row.isRight()) result["change"] = row.change;
    return result;
}

} // namespace

std::string sharesText(const Explanation& explanation) {
    constexpr std::size_t most = 3; // a line of a terminal holds no more
    if (explanation.isRight()) return "nothing is wrong";
    std::vector<std::string> shares;
    double others = 100;
    for (const auto& [cause, error] : explanation.parts) {
        const double percent = 100 * error / explanation.error;
        if (shares.size() == most || std::round(percent) == 0) break;
        shares.push_back(fmt::format("{} {:.0f}", name(cause), percent));
        others -= percent;
    }
    if (std::round(others) > 0) shares.push_back(fmt::format("others {:.0f}", others));
    return fmt::format("{}", fmt::join(shares, ", "));
}

std::string text(const CausesResult& result) {
    std::string lines;
    for (const SceneCauses& scene : result.scenes)
        lines += fmt::format(" scene: {} · {}\n{}{}\n", scene.scene, metricsOf(scene),
                             report::aligned(tableOf(scene, false)), notesOf(scene));
    return lines + " " + legend() + "\n";
}

std::string page(const CausesResult& result) {
    std::string lines = "# Why rows are wrong\n\n";
    for (const SceneCauses& scene : result.scenes) {
        lines += fmt::format("## {}\n\n{}\n\n{}\n", scene.scene, metricsOf(scene), report::markdown(tableOf(scene, true)));
        if (const std::string notes = notesOf(scene); !notes.empty()) lines += notes + "\n";
    }
    return lines + legend() + "\n";
}

std::string json(const CausesResult& result) {
    ordered_json list = ordered_json::array();
    for (const SceneCauses& scene : result.scenes) {
        ordered_json one{{"scene", scene.scene}, {"rows", ordered_json::array()}};
        for (const Explanation& row : scene.rows) one["rows"].push_back(toJson(row));
        if (!scene.withoutAnswer.empty()) one["not_applicable"] = scene.withoutAnswer;
        if (!scene.errors.empty()) one["errors"] = scene.errors;
        list.push_back(std::move(one));
    }
    return list.dump(2) + "\n";
}

} // namespace shadowbench::causes
