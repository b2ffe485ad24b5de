// Claims and verdicts for people and machines.
#include "harness/report/summary.h"
#include "harness/studies/claims/claims.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

std::string described(const Figure& figure) {
    std::string at = figure.value ? fmt::format(" at {} {:g}", figure.axis, *figure.value) : "";
    if (figure.settles) at += fmt::format(", frame from which it stays ≤ {:g}", *figure.settles);
    const std::string over = figure.over ? fmt::format(" over {} of {}", figure.over->metric, figure.over->variant) : "";
    return fmt::format("{} of {}{} on {}{}", figure.metric, figure.variant, over, figure.scene, at);
}

std::string valued(const Figure& figure, const std::optional<double>& value) {
    if (!value) return described(figure) + " is missing";
    return described(figure) + (std::isinf(*value) ? " = none" : fmt::format(" = {:.4g}", *value));
}

std::string outcome(const Finding& finding) { return !finding.holds ? "not measured" : *finding.holds ? "yes" : "no"; }

/// "figures.tiles of a on s at casters 1, 2, 4 = 3, 5, 9 grows: yes".
std::string describedGrowth(const Check& check, const Finding& finding) {
    std::vector<std::string> values;
    for (const std::optional<double>& value : finding.places)
        values.push_back(value ? fmt::format("{:.4g}", *value) : "missing");
    return fmt::format("{} at {} {:g} = {} grows: {}", described(check.left), check.left.axis,
                       fmt::join(check.growsOver, ", "), fmt::join(values, ", "), outcome(finding));
}

/// "accuracy.rmse on s, theirs and ours: a 57.2, 55.1; b 88.1, 87: rank correlation 1 ≥ 0.9: yes".
std::string describedOrder(const Check& check, const Finding& finding) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < check.published.size(); ++i)
        rows.push_back(fmt::format("{} {:g}, {}", check.published[i].variant, check.published[i].number,
                                   finding.places[i] ? fmt::format("{:.4g}", *finding.places[i]) : "missing"));
    const std::string correlation = finding.left ? fmt::format(" {:.3f} ≥ {:g}", *finding.left, check.factor) : "";
    return fmt::format("{} on {}, theirs and ours: {}: rank correlation{}: {}", check.left.metric, check.left.scene,
                       fmt::join(rows, "; "), correlation, outcome(finding));
}

/// "accuracy.mismatch of a on s = 0.0147 ≤ 0.5 × accuracy.mismatch of b on s = 0.0169: no".
std::string described(const Check& check, const Finding& finding) {
    if (!check.growsOver.empty()) return describedGrowth(check, finding);
    if (!check.published.empty()) return describedOrder(check, finding);
    const std::string sign = check.atMost ? "≤" : "≥";
    const std::string right = check.right ? fmt::format("{:g} × {}", check.factor, valued(*check.right, finding.right))
                                          : fmt::format("{:g}", check.factor);
    return fmt::format("{} {} {}: {}", valued(check.left, finding.left), sign, right, outcome(finding));
}

std::string asText(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    std::string text = fmt::format("{}: {}\n    {} ({})\n", claim.id, name(judgement.verdict), claim.says, claim.where);
    if (!claim.untestable.empty()) text += fmt::format("    {}\n", claim.untestable);
    for (std::size_t i = 0; i < claim.checks.size(); ++i)
        text += fmt::format("    - {}\n      {}\n", claim.checks[i].says, described(claim.checks[i], judgement.findings[i]));
    if (const std::string basis = basisOf(judgement); !basis.empty()) text += fmt::format("    {}\n", basis);
    return text;
}

std::string asMarkdown(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    std::string figures = report::markdownText(claim.untestable);
    for (std::size_t i = 0; i < claim.checks.size(); ++i)
        figures += fmt::format("{}{}: {}", i == 0 ? "" : "<br>", report::markdownText(claim.checks[i].says),
                               report::markdownText(described(claim.checks[i], judgement.findings[i])));
    if (const std::string basis = basisOf(judgement); !basis.empty()) figures += "<br>" + report::markdownText(basis);
    return fmt::format("| {} | {} | {} | {} | {} |\n", claim.id, report::markdownText(claim.says), claim.where,
                       name(judgement.verdict), figures);
}

Json asJson(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    Json checks = Json::array();
    for (std::size_t i = 0; i < claim.checks.size(); ++i) {
        const Finding& finding = judgement.findings[i];
        Json check{{"says", claim.checks[i].says}, {"test", described(claim.checks[i], finding)}};
        if (finding.left) check["left"] = std::isinf(*finding.left) ? Json("none") : Json(*finding.left);
        if (finding.right) check["right"] = std::isinf(*finding.right) ? Json("none") : Json(*finding.right);
        for (const std::optional<double>& value : finding.places) check["places"].push_back(value ? Json(*value) : Json());
        if (finding.holds) check["holds"] = *finding.holds;
        checks.push_back(std::move(check));
    }
    Json json{{"id", claim.id}, {"says", claim.says}, {"where", claim.where}, {"verdict", name(judgement.verdict)}};
    if (!claim.untestable.empty()) json["untestable"] = claim.untestable;
    json["checks"] = std::move(checks);
    json["basis"] = judgement.basis;
    if (!claim.replay.empty()) json["replay"] = claim.replay;
    return json;
}

} // namespace

std::vector<std::string> describedFindings(const Judgement& judgement) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < judgement.findings.size(); ++i)
        lines.push_back(described(judgement.claim->checks[i], judgement.findings[i]));
    return lines;
}

std::string basisOf(const Judgement& judgement) {
    std::string text;
    if (!judgement.basis.empty()) text = fmt::format("measured on {}", fmt::join(judgement.basis, "; "));
    if (!judgement.claim->replay.empty())
        text += fmt::format("{}computed again in double precision by {}", text.empty() ? "" : "; ", judgement.claim->replay);
    return text;
}

std::string claimsReport(const std::vector<Judgement>& judgements, const std::string& format) {
    if (format == "json") {
        Json all = Json::array();
        for (const Judgement& judgement : judgements) all.push_back(asJson(judgement));
        return all.dump(2) + "\n";
    }
    std::string text = format == "md" ? "| # | claim | where | verdict | figures |\n|---|---|---|---|---|\n" : "";
    for (const Judgement& judgement : judgements) text += format == "md" ? asMarkdown(judgement) : asText(judgement);
    return text;
}

} // namespace shadowbench
