#include "gate/policy.h"

#include "base/error.h"
#include "base/json_text.h"
#include "gate/bounds.h"
#include "harness/cells/environment.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include "embedded_gate_policy.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::gate {
namespace {

using OrderedJson = nlohmann::ordered_json;

// The shape of each entry, once.
void fields(auto&& visit, auto& rule) requires requires { rule.except; }
{
    visit("scene", rule.scene);
    visit("techniques", rule.techniques);
    visit("except", rule.except);
    visit("reason", rule.reason);
}
void fields(auto&& visit, auto& rule) requires requires { rule.bound; }
{
    fields(visit, rule.cells);
    visit("metric", rule.bound.metric);
    visit("value", rule.bound.value);
    visit("below", rule.bound.below);
}
void fields(auto&& visit, auto& sweep) requires requires { sweep.axis; }
{
    fields(visit, sweep.cells);
    visit("axis", sweep.axis);
    visit("values", sweep.values);
}

void fields(auto&& visit, auto& waiver) requires requires { waiver.expires; }
{
    visit("scene", waiver.scene);
    visit("techniques", waiver.techniques);
    visit("class", waiver.what);
    visit("reason", waiver.reason);
    visit("expires", waiver.expires);
}
void fields(auto&& visit, auto& limit) requires requires { limit.absent; }
{
    numbers(visit, limit);
    visit("truth", limit.truth);
    visit("of", limit.of);
    visit("magnitude", limit.magnitude);
    visit("best", limit.best);
    visit("absent", limit.absent);
}
// Of a time rule, larger is looser but for α.
void fields(auto&& visit, auto& rule) requires requires { rule.wallFloor; }
{
    visit("floor", rule.floor);
    visit("wall_floor", rule.wallFloor);
    visit("must_tell", rule.mustTell);
    visit("alpha", rule.alpha);
}

/// The lists of a config, once.
void lists(auto&& visit, auto& config) {
    visit("scene", config.scenes);
    visit("bound", config.bounds);
    visit("sweep", config.sweeps);
    visit("count", config.counted);
    visit("time", config.timed);
    visit("seeds", config.seeds);
    visit("choices", config.choices);
    visit("waiver", config.waivers);
}

OrderedJson policyJson(const Policy& policy) {
    OrderedJson json{{"standard", policy.standard}};
    lists(
        [&](const char* key, const auto& list) {
            OrderedJson& entries = json[key] = OrderedJson::array();
            for (const auto& entry : list) {
                OrderedJson& written = entries.emplace_back(OrderedJson::object());
                fields([&](const char* name, const auto& member) { written[name] = member; }, entry);
            }
        },
        policy.config);
    const auto into = [](OrderedJson& object) {
        return [&object](const char* name, const auto& member) { object[name] = member; };
    };
    OrderedJson& rules = json["rules"] = OrderedJson::object();
    auto number = into(rules);
    numbers(number, policy.rules);
    for (const auto& [path, limit] : policy.rules.limits) fields(into(rules["limits"][path]), limit);
    fields(into(json["time_rule"]), policy.time);
    return json;
}

Policy policyFrom(const OrderedJson& json) {
    Policy policy;
    json.at("standard").get_to(policy.standard);
    lists(
        [&](const char* key, auto& list) {
            if (!json.contains(key)) return; // a kind of entry that came later
            for (const OrderedJson& entry : json.at(key))
                fields([&](const char* name, auto& member) { entry.at(name).get_to(member); }, list.emplace_back());
        },
        policy.config);
    const auto from = [](const OrderedJson& object) {
        return [&object](const char* name, auto& member) {
            if (object.contains(name)) object.at(name).get_to(member);
        };
    };
    if (json.contains("rules")) {
        policy.rules = {};
        auto number = from(json.at("rules"));
        numbers(number, policy.rules);
        for (const auto& [path, limit] : json.at("rules").at("limits").items())
            fields(from(limit), policy.rules.limits[path]);
    }
    if (json.contains("time_rule")) fields(from(json.at("time_rule")), policy.time);
    return policy;
}

/// Units as lists of words, so that no line of the text grows with the tree.
OrderedJson reachJson(const Reach& reach) {
    OrderedJson units = OrderedJson::array();
    std::istringstream lines(reach.text());
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        units.push_back(std::vector<std::string>(std::istream_iterator<std::string>(words), {}));
    }
    return units;
}

Reach reachFrom(const OrderedJson& units) {
    std::string text;
    for (const OrderedJson& unit : units) text += fmt::format("{}\n", fmt::join(unit.get<std::vector<std::string>>(), " "));
    return Reach(text);
}

Policy withScenes(GateConfig config, Profile profile) {
    Policy policy{standardScenes(), std::move(config), ownRules(), {}};
    if (profile != Profile::Gate) return policy; // what scenes expect, they expect of this profile
    for (const std::string& id : builtinScenes())
        for (BoundRule& bound : boundsOf(loadScene(id, profile, metrics::boundedMetrics())))
            policy.config.bounds.push_back(std::move(bound));
    return policy;
}

Policy carriedPolicy(Profile profile) {
    const embedded::File& bounds = embedded::gate_policy().front();
    return withScenes(parseGateConfig(std::string(bounds.text), std::string(bounds.path), profile), profile);
}

bool holdsAll(const std::vector<std::string>& all, const std::vector<std::string>& some) {
    return std::ranges::all_of(some, [&](const auto& s) { return std::ranges::find(all, s) != all.end(); });
}

// Whether `head` asks for as much as `base`.
bool asStrict(const GateRule& head, const GateRule& base) {
    return head.scene == base.scene && holdsAll(head.techniques, base.techniques) && holdsAll(base.except, head.except);
}
bool asStrict(const BoundRule& head, const BoundRule& base) {
    return asStrict(head.cells, base.cells) && head.bound.metric == base.bound.metric &&
           head.bound.below == base.bound.below &&
           (base.bound.below ? head.bound.value <= base.bound.value : head.bound.value >= base.bound.value);
}
bool asStrict(const SweepRule& head, const SweepRule& base) {
    return asStrict(head.cells, base.cells) && head.axis == base.axis && head.values == base.values;
}

template <class Entry>
void keepLoosened(std::vector<Entry>& base, const std::vector<Entry>& head) {
    std::erase_if(base, [&](const Entry& entry) {
        return std::ranges::any_of(head, [&](const Entry& other) { return asStrict(other, entry); });
    });
}

std::string text(const GateRule& rule) { return fmt::format("{} on {}", fmt::join(rule.techniques, ", "), rule.scene); }
std::string text(const BoundRule& rule) { return fmt::format("{}: {}", text(rule.cells), gate::text(rule.bound)); }
std::string text(const SweepRule& sweep) { return fmt::format("{} over {}", text(sweep.cells), sweep.axis); }
std::string text(const Waiver& waiver) {
    return fmt::format("{} of {} on {} until {}: {}", waiver.what, fmt::join(waiver.techniques, ", "), waiver.scene,
                       waiver.expires, waiver.reason);
}

/// Entries of `base` that `head` does not have at least as strict. A waiver makes nothing stricter.
GateConfig looserEntries(const Policy& base, const Policy& head) {
    GateConfig before = base.config;
    const GateConfig& now = head.config;
    keepLoosened(before.scenes, now.scenes);
    keepLoosened(before.bounds, now.bounds);
    keepLoosened(before.sweeps, now.sweeps);
    keepLoosened(before.counted, now.counted);
    keepLoosened(before.timed, now.timed);
    keepLoosened(before.seeds, now.seeds);
    keepLoosened(before.choices, now.choices);
    before.waivers.clear();
    return before;
}

/// Standard scenes of the base that the head does not judge.
std::vector<std::string> lostScenes(const Policy& base, const Policy& head) {
    std::vector<std::string> lost = base.standard;
    std::erase_if(lost, [&](const auto& scene) { return holdsAll(head.standard, {scene}); });
    return lost;
}

} // namespace

Policy readPolicy(const std::filesystem::path& bounds, Profile profile) {
    if (std::filesystem::exists(bounds)) return withScenes(readGateConfig(bounds, profile), profile);
    if (bounds == usualBounds) return carriedPolicy(profile);
    throw Inconclusive(fmt::format("the gate's bounds file {} is missing; name another with --bounds", bounds.string()));
}

BuildInfo ownBuildInfo() {
    const Commit commit = builtFrom();
    return {commit.hash, commit.dirty, programHash(), carriedPolicy(Profile::Gate), Reach::own()};
}

std::string toJson(const BuildInfo& build) {
    return OrderedJson{{"commit", build.commit},
                       {"dirty", build.dirty},
                       {"program", build.program},
                       {"reach", reachJson(build.reach)},
                       {"policy", policyJson(build.policy)}}
               .dump(1) +
           "\n";
}

BuildInfo buildInfoFrom(const std::string& text) {
    try {
        const OrderedJson json = OrderedJson::parse(boundedJson(text, "a program's policy"));
        return {json.at("commit").get<std::string>(), json.at("dirty").get<bool>(), json.at("program").get<std::string>(),
                policyFrom(json.at("policy")), reachFrom(json.value("reach", OrderedJson::array()))};
    } catch (const OrderedJson::exception& error) {
        throw BadInput(fmt::format("a program's policy cannot be read: {}", error.what()));
    }
}

std::vector<std::string> loosened(const Policy& base, const Policy& head) {
    std::vector<std::string> sentences;
    for (const std::string& scene : lostScenes(base, head))
        sentences.push_back(fmt::format("the base's standard scene {} is none of this build's", scene));
    const GateConfig looser = looserEntries(base, head);
    lists(
        [&](const char* key, const auto& list) {
            for (const auto& entry : list)
                sentences.push_back(fmt::format("the base's [{}] {} is gone or looser here", key, text(entry)));
        },
        looser);
    for (std::string& sentence : loosened(base.rules, head.rules)) sentences.push_back(std::move(sentence));
    const TimeRule &was = base.time, &is = head.time;
    if (is.floor > was.floor || is.wallFloor > was.wallFloor || is.mustTell > was.mustTell || is.alpha < was.alpha)
        sentences.emplace_back("the rule of times is looser than the base's");
    for (const Waiver& waiver : head.config.waivers)
        if (std::ranges::find(base.config.waivers, text(waiver), [](const Waiver& w) { return text(w); }) ==
            base.config.waivers.end())
            sentences.push_back("this build accepts, and its base does not, " + text(waiver));
    return sentences;
}

Union unite(const Policy& base, const Policy& head) {
    Union result{head, loosened(base, head)};
    const auto join = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    join(result.policy.standard, lostScenes(base, head));
    GateConfig& all = result.policy.config;
    const GateConfig some = looserEntries(base, head);
    join(all.scenes, some.scenes);
    all.sweeps.insert(all.sweeps.begin(), some.sweeps.begin(), some.sweeps.end()); // the first of an axis decides its values
    join(all.counted, some.counted);
    join(all.timed, some.timed);
    join(all.seeds, some.seeds);
    join(all.choices, some.choices);
    for (const BoundRule& rule : some.bounds)
        if (metrics::boundedMetric(rule.bound.metric) != nullptr) all.bounds.push_back(rule);
    result.policy.rules = stricter(base.rules, head.rules);
    const TimeRule &was = base.time, &is = head.time;
    result.policy.time = {std::min(was.floor, is.floor), std::min(was.wallFloor, is.wallFloor),
                          std::min(was.mustTell, is.mustTell), std::max(was.alpha, is.alpha)};
    return result;
}

} // namespace shadowbench::gate
