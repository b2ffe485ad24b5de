#include "report/text_table.h"
#include "studies/causes/causes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace shadowbench::causes {
namespace {

using nlohmann::ordered_json;

std::string errorText(const Explanation& row) {
    return row.metric == "mismatch" ? fmt::format("{:.3g} %", 100 * row.error) : fmt::format("{:.3g}", row.error);
}

constexpr std::size_t lineLength = 110; // of a terminal

/// The words with commas between them, in lines that begin with a space.
std::string listed(std::string line, const std::vector<std::string>& words) {
    std::string lines;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string word = words[i] + (i + 1 < words.size() ? "," : "");
        if (line.size() + 1 + word.size() > lineLength) lines += std::exchange(line, "") + "\n";
        line += " " + word;
    }
    return lines + line;
}

std::string legend() {
    std::vector<std::string> colours{"black not scored", "grey right"};
    for (const CauseWords& cause : allCauses()) colours.push_back(fmt::format("{} {}", cause.colourName, cause.name));
    return listed("pictures:", colours);
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

/// The first of the parts, without those that are next to nothing.
std::span<const std::pair<Cause, double>> largest(const Explanation& row, std::size_t most) {
    std::size_t count = 0;
    while (count < std::min(most, row.parts.size()) && std::round(100 * row.parts[count].second / row.error) > 0) ++count;
    return std::span(row.parts).first(count);
}

std::string largestText(const Explanation& row, std::size_t most) {
    if (row.isRight()) return "nothing is wrong";
    std::vector<std::string> shares;
    for (const auto& [cause, error] : largest(row, most))
        shares.push_back(fmt::format("{} {:.0f}", name(cause), 100 * error / row.error));
    return fmt::format("{}", fmt::join(shares, ", "));
}

/// Linked to pictures: of a page, which has room for more.
report::TextTable tableOf(const SceneCauses& scene, bool linked) {
    constexpr std::size_t onALine = 2;
    report::TextTable table{
        {"row", "error", linked ? "causes, in % of the error" : "largest causes, in % of the error", "change first"}, {}};
    for (const Explanation& row : scene.rows) {
        const std::string name =
            linked && !row.isRight() ? fmt::format("[{}]({})", row.variant, pictureOf(row).string()) : row.variant;
        table.rows.push_back(
            {name, errorText(row), linked ? sharesText(row) : largestText(row, onALine), row.isRight() ? "–" : row.change});
    }
    return table;
}

std::string notesOf(const SceneCauses& scene) {
    std::string lines;
    std::map<std::string, std::vector<std::string>> byReason;
    for (const auto& [variant, reason] : scene.withoutAnswer) byReason[reason].push_back(variant);
    for (const auto& [reason, variants] : byReason) lines += listed(fmt::format(" {}:", reason), variants) + "\n";
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
    constexpr std::size_t most = 3; // a line of a recommendation holds no more
    if (explanation.isRight()) return largestText(explanation, most);
    double others = 1;
    for (const auto& [cause, error] : largest(explanation, most)) others -= error / explanation.error;
    const std::string rest = std::round(100 * others) > 0 ? fmt::format(", others {:.0f}", 100 * others) : "";
    return largestText(explanation, most) + rest;
}

std::string text(const CausesResult& result) {
    std::string lines;
    for (const SceneCauses& scene : result.scenes) {
        lines += fmt::format(" scene: {}", scene.scene);
        if (!scene.rows.empty())
            lines += fmt::format(" · {}\n{}", metricsOf(scene), report::aligned(tableOf(scene, false)));
        else
            lines += "\n";
        lines += notesOf(scene) + "\n";
    }
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
