#include "harness/studies/claims/claims.h"

#include "base/error.h"
#include "embedded_claims.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& claim, const std::string& complaint) {
    throw BadInput(fmt::format("reading claims: {}: {}", claim.empty() ? "a claim without id" : claim, complaint));
}

/// The members of one object; unknown and missing keys are errors.
class Members {
public:
    Members(const Json& object, std::string claim, std::vector<std::string> known)
        : object_(object), claim_(std::move(claim)) {
        if (!object.is_object()) refuse(claim_, "an object is expected, not " + object.dump());
        for (const auto& [key, value] : object.items())
            if (std::ranges::find(known, key) == known.end()) refuse(claim_, fmt::format("\"{}\" is no key", key));
    }

    [[nodiscard]] std::string text(const char* key) const {
        const Json& value = get(key);
        if (!value.is_string()) refuse(claim_, fmt::format("\"{}\" must be text", key));
        return value.get<std::string>();
    }
    [[nodiscard]] double number(const char* key) const {
        const Json& value = get(key);
        if (!value.is_number()) refuse(claim_, fmt::format("\"{}\" must be a number", key));
        return value.get<double>();
    }
    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const Json& get(const char* key) const {
        if (!has(key)) refuse(claim_, fmt::format("\"{}\" is missing", key));
        return object_[key];
    }

private:
    const Json& object_;
    std::string claim_;
};

/// Scene, variant and metric; no place on an axis.
Figure parseFigureAnywhere(const Members& members, const std::string& claim) {
    Figure figure{members.text("scene"), members.text("variant"), members.text("metric"), "", {}, {}};
    if (!members.has("over")) return figure;
    const Members over(members.get("over"), claim, {"variant", "metric"});
    figure.over = Figure::Divisor{over.text("variant"), over.text("metric")};
    return figure;
}

Figure parseFigure(const Json& json, const std::string& claim) {
    const Members members(json, claim, {"scene", "variant", "metric", "over", "axis", "value"});
    Figure figure = parseFigureAnywhere(members, claim);
    if (members.has("axis")) {
        figure.axis = members.text("axis");
        figure.value = members.number("value");
    }
    return figure;
}

/// A check that a figure grows over an axis.
Check parseGrowth(const Json& json, const std::string& claim) {
    const Members members(json, claim, {"says", "left", "grows over"});
    const Members left(members.get("left"), claim, {"scene", "variant", "metric", "over", "axis"});
    Check check{members.text("says"), parseFigureAnywhere(left, claim), true, 1, {}, {}};
    check.left.axis = left.text("axis");
    const Json& places = members.get("grows over");
    if (!places.is_array() || places.size() < 2) refuse(claim, "\"grows over\" must list two values of the axis or more");
    for (const Json& place : places) {
        if (!place.is_number()) refuse(claim, "\"grows over\" must list numbers");
        check.growsOver.push_back(place.get<double>());
    }
    return check;
}

Check parseCheck(const Json& json, const std::string& claim) {
    if (json.is_object() && json.contains("grows over")) return parseGrowth(json, claim);
    const Members members(json, claim, {"says", "left", "is", "times", "right", "bound"});
    Check check{members.text("says"), parseFigure(members.get("left"), claim), true, 1, {}, {}};
    const std::string is = members.text("is");
    if (is != "at most" && is != "at least")
        refuse(claim, fmt::format("\"is\" must be \"at most\" or \"at least\", not \"{}\"", is));
    check.atMost = is == "at most";
    if (members.has("bound") == members.has("right")) refuse(claim, "a check has either \"right\" or \"bound\"");
    if (members.has("right")) check.right = parseFigure(members.get("right"), claim);
    if (members.has("bound"))
        check.factor = members.number("bound");
    else if (members.has("times"))
        check.factor = members.number("times");
    return check;
}

Claim parseClaim(const Json& json) {
    const std::string id =
        json.is_object() && json.contains("id") && json["id"].is_string() ? json["id"].get<std::string>() : "";
    const Members members(json, id, {"id", "says", "where", "checks", "untestable"});
    Claim claim{members.text("id"), members.text("says"), members.text("where"), {}, ""};
    if (members.has("untestable") == members.has("checks")) refuse(id, "a claim has either \"checks\" or \"untestable\"");
    if (members.has("untestable")) claim.untestable = members.text("untestable");
    if (members.has("checks"))
        for (const Json& check : members.get("checks")) claim.checks.push_back(parseCheck(check, id));
    if (claim.checks.empty() && claim.untestable.empty()) refuse(id, "\"checks\" is empty");
    return claim;
}

bool matches(const Record& record, const Figure& figure) {
    if (record.scene != figure.scene || record.sweep.has_value() != figure.value.has_value()) return false;
    if (!record.sweep) return record.variant == figure.variant;
    return record.sweep->axis == figure.axis && record.sweep->value == *figure.value &&
           record.sweep->curve == figure.variant;
}

std::optional<double> numberAt(const Record& record, const std::string& path) {
    Json json = Json::parse(toJson(record));
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        const std::string key = path.substr(start, end - start);
        if (!json.is_object() || !json.contains(key)) return std::nullopt;
        Json inner = std::move(json[key]);
        json = std::move(inner);
        start = end + 1;
    }
    return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::optional<double> lookUp(const Figure& figure, const std::vector<Record>& records) {
    const auto record = std::ranges::find_if(records, [&](const Record& r) { return matches(r, figure); });
    const std::optional<double> number = record == records.end() ? std::nullopt : numberAt(*record, figure.metric);
    if (!number || !figure.over) return number;
    const Figure divisor{figure.scene, figure.over->variant, figure.over->metric, figure.axis, figure.value, {}};
    const std::optional<double> divided = lookUp(divisor, records);
    return divided && *divided != 0 ? std::optional(*number / *divided) : std::nullopt;
}

Finding examineGrowth(const Check& check, const std::vector<Record>& records) {
    Finding finding;
    for (const double place : check.growsOver) {
        Figure there = check.left;
        there.value = place;
        finding.places.push_back(lookUp(there, records));
    }
    if (std::ranges::any_of(finding.places, [](const auto& value) { return !value; })) return finding;
    finding.holds = std::ranges::adjacent_find(finding.places, std::greater_equal<>()) == finding.places.end();
    return finding;
}

Finding examine(const Check& check, const std::vector<Record>& records) {
    if (!check.growsOver.empty()) return examineGrowth(check, records);
    Finding finding{lookUp(check.left, records), {}, {}};
    if (check.right) finding.right = lookUp(*check.right, records);
    if (!finding.left || (check.right && !finding.right)) return finding;
    const double bound = check.factor * finding.right.value_or(1);
    finding.holds = check.atMost ? *finding.left <= bound : *finding.left >= bound;
    return finding;
}

Verdict verdictOf(const std::vector<Finding>& findings) {
    if (std::ranges::any_of(findings, [](const Finding& f) { return !f.holds; })) return Verdict::NotMeasured;
    const auto held = std::ranges::count_if(findings, [](const Finding& f) { return *f.holds; });
    if (held == 0) return Verdict::NotReproduced;
    return held == std::ssize(findings) ? Verdict::Reproduced : Verdict::Partly;
}

} // namespace

std::string_view name(Verdict verdict) {
    switch (verdict) {
    case Verdict::Reproduced:
        return "reproduced";
    case Verdict::Partly:
        return "partly";
    case Verdict::NotReproduced:
        return "not reproduced";
    case Verdict::NotTestable:
        return "not testable here";
    case Verdict::NotMeasured:
        return "not measured";
    }
    return "";
}

const std::vector<Claim>& claims() {
    static const std::vector<Claim> all = parseClaims(embedded::claims().front().text);
    return all;
}

std::vector<Claim> parseClaims(std::string_view json) {
    const Json list = Json::parse(json, nullptr, false);
    if (!list.is_array()) throw BadInput("reading claims: not a JSON list");
    std::vector<Claim> result;
    for (const Json& claim : list) result.push_back(parseClaim(claim));
    return result;
}

Judgement judge(const Claim& claim, const std::vector<Record>& records) {
    if (!claim.untestable.empty()) return {&claim, Verdict::NotTestable, {}};
    std::vector<Finding> findings;
    for (const Check& check : claim.checks) findings.push_back(examine(check, records));
    const Verdict verdict = verdictOf(findings);
    return {&claim, verdict, std::move(findings)};
}

} // namespace shadowbench
