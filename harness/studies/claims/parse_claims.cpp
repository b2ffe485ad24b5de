// Claims as JSON.
#include "harness/studies/claims/claims.h"

#include "base/error.h"
#include "base/json_text.h"
#include "embedded_claims.h"
#include "harness/studies/json_members.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

/// Scene, variant and metric; no place on an axis.
Figure parseFigureAnywhere(const JsonMembers& members) {
    Figure figure;
    figure.scene = members.text("scene");
    figure.variant = members.text("variant");
    figure.metric = members.text("metric");
    if (members.has("over")) {
        const JsonMembers over(members.get("over"), members.what(), {"variant", "metric"});
        figure.over = Figure::Divisor{over.text("variant"), over.text("metric")};
    }
    if (members.has("profile")) figure.profile = members.text("profile");
    if (members.has("settles")) figure.settles = members.number("settles");
    return figure;
}

Figure parseFigure(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"scene", "variant", "profile", "metric", "over", "axis", "value", "settles"});
    Figure figure = parseFigureAnywhere(members);
    if (members.has("axis")) {
        figure.axis = members.text("axis");
        figure.value = members.number("value");
    }
    return figure;
}

/// A check that a figure grows over an axis.
Check parseGrowth(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"says", "left", "grows over"});
    const JsonMembers left(members.get("left"), what, {"scene", "variant", "profile", "metric", "over", "axis", "settles"});
    Check check;
    check.says = members.text("says");
    check.left = parseFigureAnywhere(left);
    check.left.axis = left.text("axis");
    const Json& places = members.get("grows over");
    if (!places.is_array() || places.size() < 2) refuseJson(what, "\"grows over\" must list two values of the axis or more");
    for (const Json& place : places) {
        if (!place.is_number()) refuseJson(what, "\"grows over\" must list numbers");
        check.growsOver.push_back(place.get<double>());
    }
    return check;
}

/// A check that our numbers stand in the order of those of a published table.
Check parseOrder(const Json& json, const std::string& what) {
    const JsonMembers members(json, what, {"says", "scene", "profile", "metric", "published", "rank correlation at least"});
    Check check;
    check.says = members.text("says");
    check.left.scene = members.text("scene");
    check.left.metric = members.text("metric");
    if (members.has("profile")) check.left.profile = members.text("profile");
    check.atMost = false;
    check.factor = members.number("rank correlation at least");
    const Json& published = members.get("published");
    if (!published.is_object() || published.size() < 2)
        refuseJson(what, "\"published\" must give the document's numbers of two variants or more");
    for (const auto& [variant, number] : published.items()) {
        if (!number.is_number()) refuseJson(what, fmt::format("the published number of {} must be a number", variant));
        check.published.push_back({variant, number.get<double>()});
    }
    return check;
}

Check parseCheck(const Json& json, const std::string& what) {
    if (json.is_object() && json.contains("grows over")) return parseGrowth(json, what);
    if (json.is_object() && json.contains("published")) return parseOrder(json, what);
    const JsonMembers members(json, what, {"says", "left", "is", "times", "right", "bound"});
    Check check;
    check.says = members.text("says");
    check.left = parseFigure(members.get("left"), what);
    const std::string is = members.text("is");
    if (is != "at most" && is != "at least")
        refuseJson(what, fmt::format("\"is\" must be \"at most\" or \"at least\", not \"{}\"", is));
    check.atMost = is == "at most";
    if (members.has("bound") == members.has("right")) refuseJson(what, "a check has either \"right\" or \"bound\"");
    if (members.has("right")) check.right = parseFigure(members.get("right"), what);
    if (members.has("bound"))
        check.factor = members.number("bound");
    else if (members.has("times"))
        check.factor = members.number("times");
    return check;
}

Claim parseClaim(const Json& json) {
    const std::string id = json.is_object() && json.contains("id") && json["id"].is_string() ? json["id"].get<std::string>()
                                                                                             : "a claim without id";
    const std::string what = "claims: " + id;
    const JsonMembers members(json, what, {"id", "says", "where", "checks", "untestable", "replay"});
    Claim claim{members.text("id"), members.text("says"), members.text("where"), {}, "", ""};
    if (members.has("untestable") == members.has("checks"))
        refuseJson(what, "a claim has either \"checks\" or \"untestable\"");
    if (members.has("untestable")) claim.untestable = members.text("untestable");
    if (members.has("replay")) claim.replay = members.text("replay");
    if (members.has("checks"))
        for (const Json& check : members.get("checks")) claim.checks.push_back(parseCheck(check, what));
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
