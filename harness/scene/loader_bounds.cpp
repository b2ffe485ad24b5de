// What a scene file says of scores: a viewer's tolerances, and what is expected of techniques.
#include "harness/scene/loader.h"

namespace shadowbench {
namespace {

/// Metrics that a bound can be put on.
const std::vector<std::string>& boundedMetrics() {
    static const std::vector<std::string> names{"mismatch",
                                                "mismatch_off_edge",
                                                "false_shadow",
                                                "leak",
                                                "edge_error",
                                                "bad30",
                                                "bad8",
                                                "mae",
                                                "rmse",
                                                "penumbra_rmse",
                                                "penumbra_width_error",
                                                "umbra_leak",
                                                "flicker",
                                                "flip_rate",
                                                "convergence",
                                                "pop"};
    return names;
}

std::string readSentence(const TomlValue& value) {
    std::string text = value.text();
    if (text.empty()) value.fail("is empty; say it in a few words");
    return text;
}

/// `bound` is the key of the bound: "above" or "below".
std::vector<Expectation> readExpectationList(const TomlValue& list, const std::string& bound) {
    std::vector<Expectation> expectations;
    for (const TomlValue& entry : list.list()) {
        entry.only({"technique", "metric", bound, "reason"});
        expectations.push_back({readSentence(entry.get("technique")), entry.get("metric").oneOf(boundedMetrics()),
                                entry.get(bound).positive(), readSentence(entry.get("reason"))});
    }
    return expectations;
}

} // namespace

std::map<std::string, double> readTolerances(const TomlValue& value) {
    std::map<std::string, double> tolerance;
    for (const TomlValue& entry : value.only(boundedMetrics()).members())
        tolerance[std::string(entry.lastKey())] = entry.positive();
    return tolerance;
}

void readExpectations(const TomlValue& value, Scene& scene) {
    value.only({"fails", "holds"});
    if (const auto fails = value.find("fails")) scene.fails = readExpectationList(*fails, "above");
    if (const auto holds = value.find("holds")) scene.holds = readExpectationList(*holds, "below");
}

} // namespace shadowbench
