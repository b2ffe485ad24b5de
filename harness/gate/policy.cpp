#include "harness/gate/policy.h"

#include "base/error.h"
#include "base/json_text.h"
#include "harness/cells/environment.h"
#include "harness/gate/bounds.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include "embedded_gate_policy.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench::gate {
namespace {

using Json = nlohmann::ordered_json;

// The shape of each entry, once.
void fields(auto&& visit, auto& watch) requires requires { watch.techniques; }
{
    visit("scene", watch.scene);
    visit("techniques", watch.techniques);
    visit("except", watch.except);
    visit("reason", watch.reason);
}
void fields(auto&& visit, auto& bound) requires requires { bound.below; }
{
    fields(visit, bound.cells);
    visit("metric", bound.metric);
    visit("value", bound.value);
    visit("below", bound.below);
}
void fields(auto&& visit, auto& sweep) requires requires { sweep.axis; }
{
    fields(visit, sweep.cells);
    visit("axis", sweep.axis);
    visit("values", sweep.values);
}

/// The lists of a watchlist, once.
void lists(auto&& visit, auto& watchlist) {
    visit("scene", watchlist.scenes);
    visit("bound", watchlist.bounds);
    visit("sweep", watchlist.sweeps);
    visit("count", watchlist.counted);
    visit("time", watchlist.timed);
    visit("seeds", watchlist.seeds);
    visit("choices", watchlist.choices);
}

Json policyJson(const Policy& policy) {
    Json json{{"standard", policy.standard}};
    lists(
        [&](const char* key, const auto& list) {
            Json& entries = json[key] = Json::array();
            for (const auto& entry : list) {
                Json& written = entries.emplace_back(Json::object());
                fields([&](const char* name, const auto& member) { written[name] = member; }, entry);
            }
        },
        policy.watchlist);
    return json;
}

Policy policyFrom(const Json& json) {
    Policy policy;
    json.at("standard").get_to(policy.standard);
    lists(
        [&](const char* key, auto& list) {
            if (!json.contains(key)) return; // a kind of entry that came later
            for (const Json& entry : json.at(key))
                fields([&](const char* name, auto& member) { entry.at(name).get_to(member); }, list.emplace_back());
        },
        policy.watchlist);
    return policy;
}

Policy withScenes(Watchlist watchlist, Profile profile) {
    Policy policy{standardScenes(), std::move(watchlist)};
    if (profile != Profile::Gate) return policy; // what scenes expect, they expect of this profile
    for (const std::string& id : builtinScenes())
        for (Bound& bound : boundsOf(loadScene(id, profile, metrics::boundedMetrics())))
            policy.watchlist.bounds.push_back(std::move(bound));
    return policy;
}

bool holdsAll(const std::vector<std::string>& all, const std::vector<std::string>& some) {
    return std::ranges::all_of(some, [&](const auto& s) { return std::ranges::find(all, s) != all.end(); });
}

// Whether `head` asks for as much as `base`.
bool asStrict(const Watch& head, const Watch& base) {
    return head.scene == base.scene && holdsAll(head.techniques, base.techniques) && holdsAll(base.except, head.except);
}
bool asStrict(const Bound& head, const Bound& base) {
    return asStrict(head.cells, base.cells) && head.metric == base.metric && head.below == base.below &&
           (base.below ? head.value <= base.value : head.value >= base.value);
}
bool asStrict(const WatchedSweep& head, const WatchedSweep& base) {
    return asStrict(head.cells, base.cells) && head.axis == base.axis && head.values == base.values;
}

template <class Entry>
void keepLoosened(std::vector<Entry>& base, const std::vector<Entry>& head) {
    std::erase_if(base, [&](const Entry& entry) {
        return std::ranges::any_of(head, [&](const Entry& other) { return asStrict(other, entry); });
    });
}

std::string text(const Watch& watch) { return fmt::format("{} on {}", fmt::join(watch.techniques, ", "), watch.scene); }
std::string text(const Bound& bound) {
    return fmt::format("{}: {} {} {}", text(bound.cells), bound.metric, bound.below ? "below" : "above", bound.value);
}
std::string text(const WatchedSweep& sweep) { return fmt::format("{} over {}", text(sweep.cells), sweep.axis); }

} // namespace

Policy readPolicy(const std::filesystem::path& bounds, Profile profile) {
    return withScenes(readWatchlist(bounds, profile), profile);
}

Identity ownIdentity() {
    const Commit commit = builtFrom();
    const embedded::File& bounds = embedded::gate_policy().front();
    return {commit.hash, commit.dirty, programHash(),
            withScenes(parseWatchlist(std::string(bounds.text), std::string(bounds.path), Profile::Gate), Profile::Gate)};
}

std::string toJson(const Identity& identity) {
    return Json{{"commit", identity.commit},
                {"dirty", identity.dirty},
                {"program", identity.program},
                {"policy", policyJson(identity.policy)}}
               .dump(1) +
           "\n";
}

Identity identityFrom(const std::string& text) {
    try {
        const Json json = Json::parse(boundedJson(text, "a program's policy"));
        return {json.at("commit").get<std::string>(), json.at("dirty").get<bool>(), json.at("program").get<std::string>(),
                policyFrom(json.at("policy"))};
    } catch (const Json::exception& error) {
        throw BadInput(fmt::format("a program's policy cannot be read: {}", error.what()));
    }
}

Policy loosened(const Policy& base, const Policy& head) {
    Policy result = base;
    std::erase_if(result.standard, [&](const auto& scene) { return holdsAll(head.standard, {scene}); });
    const Watchlist& now = head.watchlist;
    Watchlist& before = result.watchlist;
    keepLoosened(before.scenes, now.scenes);
    keepLoosened(before.bounds, now.bounds);
    keepLoosened(before.sweeps, now.sweeps);
    keepLoosened(before.counted, now.counted);
    keepLoosened(before.timed, now.timed);
    keepLoosened(before.seeds, now.seeds);
    keepLoosened(before.choices, now.choices);
    return result;
}

std::vector<std::string> sentencesOf(const Policy& loosened) {
    std::vector<std::string> sentences;
    for (const std::string& scene : loosened.standard)
        sentences.push_back(fmt::format("the base's standard scene {} is none of this build's", scene));
    lists(
        [&](const char* key, const auto& list) {
            for (const auto& entry : list)
                sentences.push_back(fmt::format("the base's [{}] {} is gone or looser here", key, text(entry)));
        },
        loosened.watchlist);
    return sentences;
}

void add(const Policy& more, Policy& policy) {
    const auto join = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    join(policy.standard, more.standard);
    Watchlist& all = policy.watchlist;
    const Watchlist& some = more.watchlist;
    join(all.scenes, some.scenes);
    for (const Bound& bound : some.bounds)
        if (metrics::boundedMetric(bound.metric) != nullptr) all.bounds.push_back(bound);
    join(all.sweeps, some.sweeps);
    join(all.counted, some.counted);
    join(all.timed, some.timed);
    join(all.seeds, some.seeds);
}

} // namespace shadowbench::gate
