// Claims as JSON.
#include "studies/claims/claims.h"

#include "base/error.h"
#include "base/json_text.h"
#include "embedded_claims.h"
#include "studies/json_members.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

const std::vector<std::string> placeKeys{"scene", "profile", "metric", "axis", "value", "settles"};

std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

/// The objects that `json` stands for, one for each combination of the values that its members list.
std::vector<Json> expanded(const Json& json, const std::string& what) {
    std::vector<Json> all{Json::object()};
    for (const auto& [key, value] : json.items()) {
        const Json values = value.is_array() ? value : Json::array({value});
        if (values.empty()) refuseJson(what, fmt::format("\"{}\" lists nothing", key));
        if (all.size() * values.size() > 1000) refuseJson(what, "more than 1000 cases are asked in one check");
        std::vector<Json> longer;
        for (const Json& one : all)
            for (const Json& member : values) {
                longer.push_back(one);
                longer.back()[key] = member;
            }
        all = std::move(longer);
    }
    return all;
}

/// Reads the members that `json` has into a figure.
Figure read(const Json& json, const std::string& what, const std::vector<std::string>& known, Figure figure) {
    const JsonMembers members(json, what, known);
    if (members.has("scene")) figure.scene = members.text("scene");
    if (members.has("variant")) figure.variant = members.text("variant");
    if (members.has("profile")) figure.profile = members.text("profile");
    if (members.has("metric")) figure.metric = members.text("metric");
    if (members.has("axis")) figure.axis = members.text("axis");
    if (members.has("value")) figure.value = members.number("value");
    if (members.has("settles")) figure.settles = members.number("settles");
    if (members.has("over")) {
        const JsonMembers over(members.get("over"), what, {"variant", "metric"});
        figure.over = Figure::Divisor{over.text("variant"), over.text("metric")};
    }
    return figure;
}

void require(const Json& json, const std::string& what, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        if (!json.contains(key)) refuseJson(what, fmt::format("\"{}\" is missing", key));
}

/// The cases in which a check is asked. What `right` leaves out is as on the left.
std::vector<Case> readCases(const Json& left, const Json* right, const std::string& what) {
    const std::vector<std::string> known = with(placeKeys, {"variant", "over"});
    if (!left.is_object()) refuseJson(what, "an object is expected, not " + left.dump());
    std::vector<Case> cases;
    for (const Json& place : expanded(left, what)) {
        cases.push_back({read(place, what, known, {}), {}});
        if (!right) continue;
        Figure other = cases.back().left;
        other.over.reset();
        cases.back().right = read(*right, what, known, other);
    }
    return cases;
}

/// A check that a figure grows over an axis.
void readGrowth(const JsonMembers& members, Check& check) {
    const std::string& what = members.what();
    const Json& left = members.get("left");
    check.cases = readCases(left, nullptr, what);
    require(left, what, {"scene", "variant", "metric", "axis"});
    const Json& places = members.get("grows over");
    if (!places.is_array() || places.size() < 2) refuseJson(what, "\"grows over\" must list two values of the axis or more");
    for (const Json& place : places) {
        if (!place.is_number()) refuseJson(what, "\"grows over\" must list numbers");
        check.growsOver.push_back(place.get<double>());
    }
}

/// A check that our numbers stand in the order of those of a published table.
void readOrder(const JsonMembers& members, Check& check) {
    const std::string& what = members.what();
    const Json& left = members.get("left");
    check.cases = readCases(left, nullptr, what);
    require(left, what, {"scene", "metric"});
    check.atMost = false;
    check.factor = members.number("rank correlation at least");
    const Json& published = members.get("published");
    if (!published.is_object() || published.size() < 2)
        refuseJson(what, "\"published\" must give the document's numbers of two variants or more");
    for (const auto& [variant, number] : published.items()) {
        if (!number.is_number()) refuseJson(what, fmt::format("the published number of {} must be a number", variant));
        check.published.push_back({variant, number.get<double>()});
    }
}

void readComparison(const JsonMembers& members, Check& check) {
    const std::string& what = members.what();
    if (members.has("bound") == members.has("right")) refuseJson(what, "a check has either \"right\" or \"bound\"");
    const Json& left = members.get("left");
    check.cases = readCases(left, members.has("right") ? &members.get("right") : nullptr, what);
    require(left, what, {"scene", "variant", "metric"});
    if (left.contains("axis") != left.contains("value")) refuseJson(what, "\"axis\" and \"value\" go together");
    const std::string is = members.text("is");
    if (is != "at most" && is != "at least")
        refuseJson(what, fmt::format("\"is\" must be \"at most\" or \"at least\", not \"{}\"", is));
    check.atMost = is == "at most";
    if (members.has("bound"))
        check.factor = members.number("bound");
    else if (members.has("times"))
        check.factor = members.number("times");
}

Check parseCheck(const Json& json, const std::string& what) {
    const bool grows = json.is_object() && json.contains("grows over");
    const bool ordered = json.is_object() && json.contains("published");
    const JsonMembers members(json, what,
                              grows     ? std::vector<std::string>{"says", "left", "grows over"}
                              : ordered ? std::vector<std::string>{"says", "left", "published", "rank correlation at least"}
                                        : std::vector<std::string>{"says", "left", "is", "times", "right", "bound"});
    Check check;
    check.says = members.text("says");
    if (grows)
        readGrowth(members, check);
    else if (ordered)
        readOrder(members, check);
    else
        readComparison(members, check);
    return check;
}

/// The checks that a member lists; those that name no scene are asked on the claim's.
std::vector<Check> readChecks(const JsonMembers& members, const char* key) {
    std::vector<Check> checks;
    if (!members.has(key)) return checks;
    for (Json check : members.get(key)) {
        const bool placed = !members.has("scene") || !check.is_object() || !check.contains("left") ||
                            !check["left"].is_object() || check["left"].contains("scene");
        if (!placed) check["left"]["scene"] = members.get("scene");
        checks.push_back(parseCheck(check, members.what()));
    }
    return checks;
}

Claim parseClaim(const Json& json) {
    const std::string id = json.is_object() && json.contains("id") && json["id"].is_string() ? json["id"].get<std::string>()
                                                                                             : "a claim without id";
    const std::string what = "claims: " + id;
    const JsonMembers members(
        json, what,
        {"id", "says", "where", "scene", "checks", "untestable", "replay", "no interval", "theirs", "ruled out", "left"});
    const auto textOf = [&](const char* key) { return members.has(key) ? members.text(key) : ""; };
    Claim claim;
    claim.id = members.text("id");
    claim.says = members.text("says");
    claim.where = members.text("where");
    if (members.has("untestable") == members.has("checks"))
        refuseJson(what, "a claim has either \"checks\" or \"untestable\"");
    claim.untestable = textOf("untestable");
    claim.replay = textOf("replay");
    claim.exact = textOf("no interval");
    claim.theirs = textOf("theirs");
    claim.left = textOf("left");
    claim.checks = readChecks(members, "checks");
    claim.ruledOut = readChecks(members, "ruled out");
    if (claim.checks.empty() && claim.untestable.empty()) refuseJson(what, "\"checks\" is empty");
    return claim;
}

} // namespace

const std::vector<Claim>& claims() {
    static const std::vector<Claim> all = parseClaims(embedded::claims().front().text);
    return all;
}

std::vector<Claim> parseClaims(std::string_view json) {
    const Json list = Json::parse(boundedJson(json, "reading claims"), nullptr, false);
    if (!list.is_array()) throw BadInput("reading claims: not a JSON list");
    std::vector<Claim> result;
    for (const Json& claim : list) result.push_back(parseClaim(claim));
    return result;
}

} // namespace shadowbench
