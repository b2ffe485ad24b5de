#include "studies/recommend/shadow_error.h"

#include "base/error.h"
#include "base/words.h"
#include "harness/metrics/frames.h"
#include "harness/metrics/values.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace shadowbench::recommend {
namespace {

const std::vector<std::string> hardMetrics{"mismatch", "false_shadow", "leak"};
const std::vector<std::string> softMetrics{"penumbra_rmse", "rmse", "mae", "bad30", "bad8", "umbra_leak"};

/// The usual one first.
const std::vector<std::string>& metricsOf(const Light& light) { return light.isArea() ? softMetrics : hardMetrics; }

/// The exact shadow as a truth whose receivers are those that both shadows label.
groundtruth::Reference truthOf(const Shadow& exact, const Receivers& receivers) {
    groundtruth::Reference truth;
    truth.visibility = exact.visibility;
    truth.sigma = Image<float>(receivers.size.x, receivers.size.y);
    truth.surface = receivers.primary.surface;
    truth.id = receivers.primary.id;
    truth.position = receivers.primary.position;
    truth.edgeDistance = Image<float>(receivers.size.x, receivers.size.y, std::numeric_limits<float>::infinity());
    return truth;
}

} // namespace

Errors hardErrors(const LabelErrors& labels) {
    Errors errors;
    const auto add = [&](const char* metric, std::size_t wrong, std::size_t all) {
        if (all > 0) errors[metric] = static_cast<double>(wrong) / static_cast<double>(all);
    };
    add("mismatch", labels.falseShadow + labels.leak, labels.lit + labels.shadowed);
    add("false_shadow", labels.falseShadow, labels.lit);
    add("leak", labels.leak, labels.shadowed);
    return errors;
}

Errors hardErrors(const Shadow& shadow, const Shadow& exact) {
    LabelErrors labels;
    for (std::size_t i = 0; i < exact.labelled.size(); ++i)
        if (shadow.labelled[i] != 0 && exact.labelled[i] != 0)
            labels.add(shadow.visibility[i] == 0, exact.visibility[i] == 0);
    return hardErrors(labels);
}

Errors softErrors(const Shadow& shadow, const Shadow& exact, const Receivers& receivers) {
    metrics::Mask mask{exact.labelled, 0, 0};
    for (std::size_t i = 0; i < mask.scored.size(); ++i) mask.scored[i] &= shadow.labelled[i];
    mask.count = static_cast<std::size_t>(std::ranges::count(mask.scored, 1));
    const groundtruth::Reference truth = truthOf(exact, receivers);
    metrics::Values values;
    metrics::compute<metrics::OfVisibility>(metrics::ScoredFrame{shadow.visibility, truth, mask}, values);
    Errors errors;
    for (const std::string& metric : softMetrics)
        if (const std::optional<double> value = metrics::bounded(values, metric)) errors[metric] = *value;
    return errors;
}

bool within(const Errors& errors, const Errors& tolerance) {
    return std::ranges::all_of(tolerance, [&](const auto& worst) {
        const auto found = errors.find(worst.first);
        return found == errors.end() || found->second <= worst.second;
    });
}

Errors ownTolerance(const Scene& scene) {
    const std::vector<std::string>& known = metricsOf(scene.light);
    Errors own = scene.tolerance;
    std::erase_if(own, [&](const auto& worst) { return std::ranges::find(known, worst.first) == known.end(); });
    return own;
}

Errors parseTolerance(const std::vector<std::string>& words, const Light& light) {
    const std::vector<std::string>& known = metricsOf(light);
    Errors tolerance;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        const std::string metric = equals == std::string::npos ? known.front() : word.substr(0, equals);
        const std::string number = equals == std::string::npos ? word : word.substr(equals + 1);
        if (std::ranges::find(known, metric) == known.end())
            throw BadInput(fmt::format("shadows of {} are not measured by \"{}\"{}; they are by {}",
                                       light.isArea() ? "an area light" : "this light", metric, didYouMean(metric, known),
                                       fmt::join(known, ", ")));
        double& worst = tolerance[metric];
        const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), worst);
        if (failed != std::errc() || end != number.data() + number.size() || !(worst >= 0))
            throw BadInput(
                fmt::format("a tolerance is a number such as 0.005, or {}=0.005, not \"{}\"", known.front(), word));
    }
    return tolerance;
}

} // namespace shadowbench::recommend
