// What a scene file demands of scores: a viewer's tolerances, and what is expected of techniques.
#include "scene/load/scene_file.h"
#include "scene/scene.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

std::string readSentence(const TomlValue& value) {
    std::string text = value.text();
    if (text.empty()) value.fail("is empty; say it in a few words");
    return text;
}

std::string readMetric(const TomlValue& value, const std::vector<std::string>& metrics) {
    return metrics.empty() ? readSentence(value) : value.oneOf(metrics);
}

/// `bound` is the key of the bound: "above" or "below".
std::vector<Expectation> readExpectationList(const TomlValue& list, const std::string& bound,
                                             const std::vector<std::string>& metrics) {
    std::vector<Expectation> expectations;
    for (const TomlValue& entry : list.list()) {
        entry.only({"technique", "metric", bound, "reason"});
        expectations.push_back({readSentence(entry.get("technique")), readMetric(entry.get("metric"), metrics),
                                entry.get(bound).positive(), readSentence(entry.get("reason"))});
    }
    return expectations;
}

glm::dvec2 readRange(const TomlValue& value) {
    const std::vector<TomlValue> ends = value.list();
    if (ends.size() != 2) value.fail(fmt::format("expected 2 numbers, got {}", ends.size()));
    const glm::dvec2 range(ends[0].number(), ends[1].number());
    if (range.x > range.y) value.fail("expected the smaller number first");
    return range;
}

/// `ranged`: every entry says between which values its technique breaks.
void readBreaks(const TomlValue& list, bool ranged, Scene& scene) {
    for (const TomlValue& entry : list.list()) {
        std::vector<std::string> keys{"technique", "axis", "reason"};
        if (ranged) keys.emplace_back("between");
        entry.only(keys);
        scene.breaks.push_back({readSentence(entry.get("technique")), readSentence(entry.get("axis")),
                                ranged ? std::optional(readRange(entry.get("between"))) : std::nullopt,
                                readSentence(entry.get("reason"))});
    }
}

} // namespace

std::map<std::string, double> readTolerances(const TomlValue& value, const std::vector<std::string>& metrics) {
    if (!metrics.empty()) value.only(metrics);
    std::map<std::string, double> tolerance;
    for (const TomlValue& entry : value.members()) tolerance[std::string(entry.lastKey())] = entry.positive();
    return tolerance;
}

void readExpectations(const TomlValue& value, const std::vector<std::string>& metrics, Scene& scene) {
    value.only({"fails", "holds", "breaks", "never_breaks"});
    if (const auto fails = value.find("fails")) scene.fails = readExpectationList(*fails, "above", metrics);
    if (const auto holds = value.find("holds")) scene.holds = readExpectationList(*holds, "below", metrics);
    if (const auto breaks = value.find("breaks")) readBreaks(*breaks, true, scene);
    if (const auto never = value.find("never_breaks")) readBreaks(*never, false, scene);
}

} // namespace shadowbench
