// Claims and verdicts for people and machines.
#include "report/summary.h"
#include "studies/claims/claims.h"
#include "studies/claims/figure_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;
using report::markdownText;

std::string asText(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    const std::vector<std::string> found = describedFindings(judgement);
    std::string text = fmt::format("{}: {}\n    {} ({})\n", claim.id, name(judgement.verdict), claim.says, claim.where);
    for (std::size_t i = 0; i < found.size(); ++i)
        text += fmt::format("    - {}\n      {}\n", claim.checks[i].says, found[i]);
    for (const std::string& line : {claim.untestable, claim.exact, paragraphOf(judgement), basisOf(judgement)})
        if (!line.empty()) text += fmt::format("    {}\n", line);
    return text;
}

std::string asMarkdown(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    const std::vector<std::string> found = describedFindings(judgement);
    std::string text = fmt::format("\n## {}\n\n{} ({}): **{}**.\n", claim.id, markdownText(claim.says),
                                   markdownText(claim.where), name(judgement.verdict));
    if (!found.empty()) text += "\n";
    for (std::size_t i = 0; i < found.size(); ++i)
        text += fmt::format("* {}: {}\n", markdownText(claim.checks[i].says), markdownText(found[i]));
    const std::string exact = claim.exact.empty() ? "" : "No interval: " + claim.exact;
    for (const std::string& line : {claim.untestable, exact, paragraphOf(judgement), basisOf(judgement)})
        if (!line.empty()) text += fmt::format("\n{}\n", markdownText(line));
    return text;
}

/// Of a heading, as GitHub makes it.
std::string anchorOf(std::string id) {
    std::ranges::transform(id, id.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return id;
}

std::string markdownPage(const std::vector<Judgement>& judgements) {
    std::string text =
        "# Claims\n\n"
        "What the papers claim, asked of the records. Each check is asked on every scene and at every place or threshold "
        "that "
        "it lists: it holds (yes) or fails (no) in all of them, or in some. Where there are records of several seeds, ± is "
        "the "
        "half width of the 95 % interval of the mean over them (Student's t), and what is compared are figures of the same "
        "seed; of times, it is that of the median of their rounds, which says nothing of another run. Where the interval of "
        "the difference has the bound inside, they are not told apart. A range, such as 58 to 209, is that over scenes, "
        "places and seeds.\n\n"
        "| # | claim | where | verdict |\n|---|---|---|---|\n";
    for (const Judgement& judgement : judgements) {
        const Claim& claim = *judgement.claim;
        text += fmt::format("| [{}](#{}) | {} | {} | {} |\n", claim.id, anchorOf(claim.id), markdownText(claim.says),
                            markdownText(claim.where), name(judgement.verdict));
    }
    for (const Judgement& judgement : judgements) text += asMarkdown(judgement);
    return text;
}

Json asJson(const std::optional<double>& number) {
    return !number ? Json() : std::isinf(*number) ? Json("none") : Json(*number);
}

Json asJson(const Check& check, const Finding& finding) {
    Json json{{"says", check.says}, {"test", describe(check, finding)}, {"outcome", name(finding.outcome)}};
    json["cases"] = Json::array();
    for (const std::vector<Sample>& samples : finding.cases) {
        Json ofCase = Json::array();
        for (const Sample& sample : samples) {
            Json one = Json::object();
            if (sample.left) one["left"] = asJson(sample.left);
            if (sample.right) one["right"] = asJson(sample.right);
            for (const std::optional<double>& value : sample.places) one["places"].push_back(asJson(value));
            if (sample.holds) one["holds"] = *sample.holds;
            ofCase.push_back(std::move(one));
        }
        json["cases"].push_back(std::move(ofCase));
    }
    return json;
}

Json asJson(const Judgement& judgement) {
    const Claim& claim = *judgement.claim;
    Json json{{"id", claim.id}, {"says", claim.says}, {"where", claim.where}, {"verdict", name(judgement.verdict)}};
    if (!claim.untestable.empty()) json["untestable"] = claim.untestable;
    json["checks"] = Json::array();
    for (std::size_t i = 0; i < judgement.findings.size(); ++i)
        json["checks"].push_back(asJson(claim.checks[i], judgement.findings[i]));
    for (std::size_t i = 0; i < judgement.ruledOut.size(); ++i)
        json["ruled out"].push_back(asJson(claim.ruledOut[i], judgement.ruledOut[i]));
    if (!claim.exact.empty()) json["no interval"] = claim.exact;
    if (const std::string paragraph = paragraphOf(judgement); !paragraph.empty()) json["paragraph"] = paragraph;
    json["basis"] = judgement.basis;
    if (!claim.replay.empty()) json["replay"] = claim.replay;
    return json;
}

} // namespace

std::vector<std::string> describedFindings(const Judgement& judgement) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < judgement.findings.size(); ++i)
        lines.push_back(describe(judgement.claim->checks[i], judgement.findings[i]));
    return lines;
}

std::string basisOf(const Judgement& judgement) {
    std::string text;
    if (!judgement.basis.empty()) text = fmt::format("measured on {}", fmt::join(judgement.basis, "; "));
    if (!judgement.claim->replay.empty())
        text += fmt::format("{}computed again in double precision by {}", text.empty() ? "" : "; ", judgement.claim->replay);
    return text;
}

bool isShort(Verdict verdict) {
    return verdict == Verdict::NotReproduced || verdict == Verdict::Partly || verdict == Verdict::NotToldApart;
}

std::string paragraphOf(const Judgement& judgement) {
    if (!isShort(judgement.verdict)) return "";
    const Claim& claim = *judgement.claim;
    std::vector<std::string> ours, ruledOut, open;
    for (std::size_t i = 0; i < claim.checks.size(); ++i)
        if (judgement.findings[i].outcome != Outcome::Yes) ours.push_back(inShort(claim.checks[i], judgement.findings[i]));
    for (std::size_t i = 0; i < claim.ruledOut.size(); ++i)
        (judgement.ruledOut[i].outcome == Outcome::Yes ? ruledOut : open)
            .push_back(inShort(claim.ruledOut[i], judgement.ruledOut[i]));
    if (!claim.replay.empty()) ruledOut.push_back("our code, whose figures a test computes again in double precision");
    std::string text = fmt::format("The document: {}. Here: {}.", claim.theirs, fmt::join(ours, "; "));
    if (!ruledOut.empty()) text += fmt::format(" Ruled out: {}.", fmt::join(ruledOut, "; "));
    if (!open.empty()) text += fmt::format(" Not ruled out: {}.", fmt::join(open, "; "));
    return text + fmt::format(" What is left: {}.", claim.left);
}

std::string claimsReport(const std::vector<Judgement>& judgements, const std::string& format) {
    if (format == "md") return markdownPage(judgements);
    if (format == "json") {
        Json all = Json::array();
        for (const Judgement& judgement : judgements) all.push_back(asJson(judgement));
        return all.dump(2) + "\n";
    }
    std::string text;
    for (const Judgement& judgement : judgements) text += asText(judgement);
    return text;
}

} // namespace shadowbench
