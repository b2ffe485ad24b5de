// Claims and verdicts for people and machines.
#include "harness/report/summary.h"
#include "harness/studies/claims/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

std::string described(const Figure& figure) {
    const std::string at = figure.value ? fmt::format(" at {} {:g}", figure.axis, *figure.value) : "";
    const std::string over = figure.over ? fmt::format(" over {} of {}", figure.over->metric, figure.over->variant) : "";
    return fmt::format("{} of {}{} on {}{}", figure.metric, figure.variant, over, figure.scene, at);
}

std::string valued(const Figure& figure, const std::optional<double>& value) {
    return described(figure) + (value ? fmt::format(" = {:.4g}", *value) : " is missing");
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

/// "accuracy.mismatch of a on s = 0.0147 ≤ 0.5 × accuracy.mismatch of b on s = 0.0169: no".
std::string described(const Check& check, const Finding& finding) {
    if (!check.growsOver.empty()) return describedGrowth(check, finding);
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
    return text;
}

std::string asMarkdown(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    std::string figures = report::markdownText(claim.untestable);
    for (std::size_t i = 0; i < claim.checks.size(); ++i)
        figures += fmt::format("{}{}: {}", i == 0 ? "" : "<br>", report::markdownText(claim.checks[i].says),
                               report::markdownText(described(claim.checks[i], judgement.findings[i])));
    return fmt::format("| {} | {} | {} | {} | {} |\n", claim.id, report::markdownText(claim.says), claim.where,
                       name(judgement.verdict), figures);
}

Json asJson(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    Json checks = Json::array();
    for (std::size_t i = 0; i < claim.checks.size(); ++i) {
        const Finding& finding = judgement.findings[i];
        Json check{{"says", claim.checks[i].says}, {"test", described(claim.checks[i], finding)}};
        if (finding.left) check["left"] = *finding.left;
        if (finding.right) check["right"] = *finding.right;
        for (const std::optional<double>& value : finding.places) check["places"].push_back(value ? Json(*value) : Json());
        if (finding.holds) check["holds"] = *finding.holds;
        checks.push_back(std::move(check));
    }
    Json json{{"id", claim.id}, {"says", claim.says}, {"where", claim.where}, {"verdict", name(judgement.verdict)}};
    if (!claim.untestable.empty()) json["untestable"] = claim.untestable;
    json["checks"] = std::move(checks);
    return json;
}

} // namespace

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
