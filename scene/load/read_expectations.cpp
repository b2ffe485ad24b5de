// What a scene file demands of scores: a viewer's tolerances, and what is expected of techniques.
#include "base/words.h"
#include "scene/load/expectations.h"
#include "scene/load/load.h"
#include "scene/load/scene_file.h"
#include "scene/scene.h"

#include <algorithm>
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

/// One variant, or a list of them.
std::vector<std::string> readVariants(const TomlValue& value) {
    if (!value.isList()) return {readSentence(value)};
    std::vector<std::string> variants;
    for (const TomlValue& one : value.list()) variants.push_back(readSentence(one));
    if (variants.empty()) value.fail("is empty; name a variant");
    return variants;
}

/// The lists "holds", whose bounds are "below", and "fails", whose are "above".
std::vector<Expectation> readExpectationLists(const TomlValue& value, const std::vector<std::string>& metrics) {
    std::vector<Expectation> expectations;
    for (const bool below : {true, false}) {
        const std::string side = below ? "below" : "above";
        const auto list = value.find(below ? "holds" : "fails");
        if (!list) continue;
        for (const TomlValue& entry : list->list()) {
            entry.only({"technique", "metric", side, "reason"});
            const Bound bound{readMetric(entry.get("metric"), metrics), entry.get(side).positive(), below};
            for (const std::string& technique : readVariants(entry.get("technique")))
                expectations.push_back({technique, bound, readSentence(entry.get("reason"))});
        }
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

/// A built-in one by its id, another by its file beside `folder`'s own.
std::string readSceneName(const TomlValue& value, const std::filesystem::path& folder) {
    const std::string name = readSentence(value);
    if (std::ranges::count(builtinScenes(), name) > 0) return name;
    if (std::filesystem::path(name).filename() != name || !std::filesystem::is_regular_file(folder / name))
        value.fail(fmt::format("\"{}\" is neither a scene that is built in nor a file beside this one{}", name,
                               didYouMean(name, builtinScenes())));
    return (folder / name).string();
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
    scene.expectations = readExpectationLists(value, metrics);
    if (const auto breaks = value.find("breaks")) readBreaks(*breaks, true, scene);
    if (const auto never = value.find("never_breaks")) readBreaks(*never, false, scene);
}

std::vector<SceneExpectations> parseExpectations(std::string_view toml, const std::filesystem::path& file,
                                                 const std::vector<std::string>& metrics) {
    const toml::table table = parseToml(toml, file.string());
    const TomlSource source{file.string(), profileNames(), std::string(name(Profile::Gate)), kLargestNumber};
    const TomlValue root(source, "", table);
    root.only({"expect"});
    std::vector<SceneExpectations> all;
    for (const TomlValue& entry : root.get("expect").list()) {
        entry.only({"scene", "fails", "holds"});
        SceneExpectations read{readSceneName(entry.get("scene"), file.parent_path()), readExpectationLists(entry, metrics)};
        if (read.expectations.empty()) entry.fail("says neither what fails nor what holds");
        if (std::ranges::count(all, read.scene, &SceneExpectations::scene) > 0)
            entry.get("scene").fail("has an entry above; put both together");
        all.push_back(std::move(read));
    }
    if (all.empty()) root.get("expect").fail("expects nothing; leave the file out");
    return all;
}

} // namespace shadowbench
