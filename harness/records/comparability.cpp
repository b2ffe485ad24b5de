#include "harness/records/comparability.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

template <typename T>
std::optional<std::string> differs(std::string_view what, const T& a, const T& b) {
    if (a == b) return {};
    return fmt::format("{} is \"{}\" and \"{}\"", what, a, b);
}

/// The same of a text that one of both may not state.
std::optional<std::string> stated(std::string_view what, const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? std::nullopt : differs(what, a, b);
}

std::optional<std::string> first(std::initializer_list<std::optional<std::string>> differences) {
    for (const std::optional<std::string>& difference : differences)
        if (difference) return difference;
    return {};
}

/// Older programs drew with OSMesa alone, and did not say so.
std::string platformOf(const Environment& e) { return e.platform.empty() ? "osmesa" : e.platform; }

std::optional<std::string> rasteriserDifference(const Environment& a, const Environment& b) {
    if (a.gl == notDrawnHere && b.gl == notDrawnHere) return {}; // another renderer's next version is what is compared
    return first({differs("renderer", a.renderer, b.renderer), differs("gl", a.gl, b.gl),
                  differs("platform", platformOf(a), platformOf(b)), stated("vendor", a.vendor, b.vendor),
                  stated("driver", a.driver, b.driver), differs("raster_threads", a.rasterThreads, b.rasterThreads),
                  differs("vector_bits", a.vectorBits, b.vectorBits), stated("mesa", a.mesa, b.mesa)});
}

std::optional<std::string> countDifference(const Environment& a, const Environment& b) {
    return first({differs("cpu", a.cpu, b.cpu), stated("cpu_features", a.cpuFeatures, b.cpuFeatures),
                  stated("libraries", a.libraries, b.libraries),
                  a.valgrind && b.valgrind ? differs("valgrind", *a.valgrind, *b.valgrind) : std::nullopt});
}

/// A new parameter, and one that is gone, leave the variant what it was; another value of one does not.
std::optional<std::string> parameterDifference(const Record& base, const Record& head) {
    for (const auto& [name, value] : head.parameters) {
        const auto before = std::ranges::find(base.parameters, name, [](const auto& p) { return p.first; });
        if (before != base.parameters.end() && before->second != value)
            return fmt::format("its parameter {} was {} and is {}", name, before->second, value);
    }
    return {};
}

std::string keyOf(const std::optional<ReferenceInfo>& reference) { return reference ? reference->key : ""; }

/// Why what was scored against two truths cannot be compared. Older records do not say what pixels a truth had.
std::optional<std::string> truthDifference(const std::optional<ReferenceInfo>& base,
                                           const std::optional<ReferenceInfo>& head) {
    if (keyOf(base) != keyOf(head)) return "it was scored against different truths: the scene or the ground truth changed";
    if (base && stated("content", base->content, head->content))
        return "it was scored against truths of one key with other pixels: the ground truth's code or tools changed";
    return {};
}

/// Why what was scored over two classes of pixels cannot be compared: one truth gives classes of one size, but for pixels of
/// which another renderer's images say nothing. So few of these as rounding leaves (docs/metrics.md, "Primary hits") decide
/// no score.
std::optional<std::string> sizeDifference(const metrics::Metric& metric, const Record& base, const Record& head) {
    constexpr double most = 0.001; // of the image, or of all frames that the class is of
    const metrics::Metric* size = metric.allowance ? metrics::metricAt(metric.allowance->of) : nullptr;
    if (size == nullptr || !base.values[*size] || !head.values[*size]) return {};
    const double before = *base.values[*size], now = *head.values[*size];
    const double all = std::max({static_cast<double>(base.width) * base.height, before, now});
    if (std::abs(now - before) <= most * all) return {};
    return fmt::format("it is over {} pixels and was over {} ({})", now, before, size->path);
}

bool statesCosts(const Record& record) {
    const auto& values = record.values;
    return !record.technique.starts_with("external:") &&
           (values["cost.time.median"] || values["lod.time.median"] || values["cost.instructions"]);
}

template <class... Kinds>
bool isOneOf(const metrics::Computation& computed) {
    return (std::holds_alternative<Kinds>(computed) || ...);
}

} // namespace

std::optional<std::string> difference(const Environment& a, const Environment& b, EnvironmentScope what) {
    if (auto found = rasteriserDifference(a, b)) return found;
    if (what == EnvironmentScope::OfScores) return {};
    if (auto found = countDifference(a, b)) return found;
    return what == EnvironmentScope::All ? differs("compiler", a.compiler, b.compiler) : std::nullopt;
}

std::string countingEnvironment(const Environment& e) {
    std::string text = fmt::format("{}, {}, {} raster threads, {} bits, {}, {}", e.renderer, e.gl, e.rasterThreads,
                                   e.vectorBits, e.valgrind.value_or("no Valgrind"), e.cpu);
    for (const std::string& more : {e.cpuFeatures, e.mesa, e.libraries})
        if (!more.empty()) text += ", " + more;
    if (platformOf(e) != "osmesa") text += ", through " + e.platform;
    return text;
}

const std::optional<ReferenceInfo>& truthOf(const metrics::Metric& metric, const Record& record) {
    const std::optional<ReferenceInfo>* beside = nullptr;
    if (isOneOf<metrics::OfVisibility, metrics::VisibilityByFrame, metrics::OfSeeds>(metric.computed))
        beside = &record.softReference;
    if (isOneOf<metrics::OfPixelAreas, metrics::OfMovingAreas>(metric.computed)) beside = &record.pixelReference;
    return beside != nullptr && *beside ? *beside : record.reference;
}

std::optional<std::string> whyIncomparable(const Record& base, const Record& head) {
    if (auto truth = truthDifference(base.reference, head.reference)) return truth;
    if (auto parameters = parameterDifference(base, head)) return parameters;
    if (base.frames != head.frames) return fmt::format("it had {} frames and has {}", base.frames, head.frames);
    if (const auto rasteriser = difference(base.environment, head.environment, EnvironmentScope::OfScores))
        return fmt::format("it was drawn by different rasterisers: {}", *rasteriser);
    return {};
}

std::optional<std::string> whyIncomparable(const metrics::Metric& metric, const Record& base, const Record& head) {
    if (auto truth = truthDifference(truthOf(metric, base), truthOf(metric, head))) return truth;
    if (isOneOf<metrics::OfMovingFrames, metrics::OfMovingAreas>(metric.computed) &&
        stated("truths", base.truths, head.truths))
        return "moving frames were scored against different truths: the scene's motion or the ground truth changed";
    return sizeDifference(metric, base, head);
}

std::vector<Record> readOfOneDevice(const std::vector<std::filesystem::path>& files) {
    std::vector<Record> records;
    for (const std::filesystem::path& file : files)
        for (Record& record : readRecords(file)) records.push_back(std::move(record));
    const Record* first = nullptr;
    for (const Record& record : records) {
        if (!statesCosts(record)) continue;
        if (first == nullptr) first = &record;
        if (const auto differs = difference(first->environment, record.environment, EnvironmentScope::OfCounts))
            throw BadInput(
                fmt::format("costs of different devices are not put side by side: of {} on {} and of {} on {}, {}; "
                            "give the records of one device alone",
                            first->variant, first->scene, record.variant, record.scene, *differs));
    }
    return records;
}

bool sameMetricCode(const Record& base, const Record& head) {
    return base.metricCode.empty() || head.metricCode.empty() || base.metricCode == head.metricCode;
}

bool sameImages(const Record& base, const Record& head) { return !base.images.empty() && base.images == head.images; }

} // namespace shadowbench::gate
