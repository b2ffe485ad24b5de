// The board of claims, and a page for each.
#include "report/summary.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/viewer/cells.h"
#include "studies/claims/figure_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace shadowbench::site {
namespace {

std::string claimAddress(const Claim& claim) { return fmt::format("claims/{}.html", slug(claim.id)); }

/// Of style.css, so that verdicts are told apart at a glance; the words say the same.
std::string kindOf(Verdict verdict) {
    switch (verdict) {
    case Verdict::Reproduced:
        return "reproduced";
    case Verdict::Partly:
    case Verdict::NotToldApart:
        return "partly";
    case Verdict::NotReproduced:
        return "refuted";
    default:
        return "unmeasured";
    }
}

std::string kindOf(Outcome outcome) {
    switch (outcome) {
    case Outcome::Yes:
        return "reproduced";
    case Outcome::No:
        return "refuted";
    case Outcome::Partly:
    case Outcome::NotToldApart:
        return "partly";
    case Outcome::NotMeasured:
        return "unmeasured";
    }
    return "";
}

/// Each check with its range of figures; the claim's page has them one by one.
std::string textOf(const Judgement& judgement) {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < judgement.findings.size(); ++i)
        found.push_back(inShort(judgement.claim->checks[i], judgement.findings[i]));
    return found.empty() ? judgement.claim->untestable : fmt::format("{}", fmt::join(found, "; "));
}

Table board(const std::vector<Judgement>& judgements) {
    Table table{.id = "claims", .caption = "The papers' claims", .rows = {}, .headed = false};
    table.columns = {{.title = "claim", .number = false},
                     {.title = "verdict", .number = false},
                     {.title = "what is claimed", .number = false, .prose = true},
                     {.title = "source", .number = false},
                     {.title = "figures", .number = false, .brief = false, .prose = true}};
    for (const Judgement& judgement : judgements) {
        const Claim& claim = *judgement.claim;
        table.rows.push_back({{Cell{.text = claim.id, .address = claimAddress(claim)},
                               Cell{.text = std::string(name(judgement.verdict)), .kind = kindOf(judgement.verdict)},
                               Cell{claim.says}, Cell{claim.where}, Cell{.text = textOf(judgement), .kind = "small"}},
                              {}});
    }
    return table;
}

/// The records that a figure is read off, as rows.
class RecordRows {
public:
    RecordRows(const std::vector<Record>& records, const std::filesystem::path& images)
        : records_(records), images_(images) {}

    void add(const Figure& figure) {
        const auto seen = [&](const Record& record) {
            if (std::ranges::find(seen_, &record) != seen_.end()) return;
            seen_.push_back(&record);
            add(record);
        };
        lookUp(figure, records_, seen);
    }

    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

private:
    void add(const Record& record) {
        const std::string place =
            record.sweep ? fmt::format("{} {:g} {}", record.sweep->axis, record.sweep->value, record.sweep->unit) : "–";
        const std::string address = record.sweep               ? sweepAddress({record.scene, record.sweep->axis, {}})
                                    : hasCell(record, images_) ? cellAddress(record)
                                                               : sceneAddress(record.scene);
        rows_.push_back({{Cell{.text = record.variant, .address = address}, Cell{record.scene}, Cell{place},
                          Cell{record.profile}, Cell{report::imageSize(record)}, Cell{std::string(name(record.status))},
                          Cell{record.commit.substr(0, 12)}, Cell{record.cell.empty() ? "–" : record.cell}},
                         {}});
    }

    const std::vector<Record>& records_;
    const std::filesystem::path& images_;
    std::vector<const Record*> seen_;
    std::vector<Row> rows_;
};

Table recordTable(const Claim& claim, const std::vector<Record>& records, const std::filesystem::path& images) {
    RecordRows found(records, images);
    for (const Check& check : claim.checks)
        for (const Figure& figure : figuresOf(check)) found.add(figure);
    Table table{.id = "records", .caption = "The records behind it", .rows = found.rows()};
    for (const char* title : {"technique", "scene", "at", "profile", "size", "status", "commit", "cell"})
        table.columns.push_back({.title = title, .number = false});
    return table;
}

Table checkTable(const Judgement& judgement) {
    Table table{.id = "checks",
                .caption = "What decides it",
                .columns = {{.title = "check", .number = false, .prose = true},
                            {.title = "holds", .number = false},
                            {.title = "figures", .number = false, .prose = true}},
                .rows = {}};
    const std::vector<std::string> found = describedFindings(judgement);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Outcome outcome = judgement.findings[i].outcome;
        table.rows.push_back({{Cell{judgement.claim->checks[i].says},
                               Cell{.text = std::string(name(outcome)), .kind = kindOf(outcome)}, Cell{found[i]}},
                              {}});
    }
    return table;
}

void addClaimPage(const Judgement& judgement, const std::vector<Record>& records, const std::filesystem::path& images,
                  SiteWriter& site) {
    const Claim& claim = *judgement.claim;
    const std::string address = claimAddress(claim), basis = basisOf(judgement);
    Data data;
    data.set("id", claim.id);
    data.set("verdict", std::string(name(judgement.verdict)));
    data.set("kind", kindOf(judgement.verdict));
    data.set("says", claim.says);
    data.set("where", claim.where);
    data.set("untestable", claim.untestable);
    data.set("exact", claim.exact.empty() ? "" : "No interval: " + claim.exact);
    data.set("paragraph", paragraphOf(judgement));
    data.set("basis", basis);
    data.set("checks", site.table(address, checkTable(judgement)));
    data.set("records", site.table(address, recordTable(claim, records, images)));
    site.add({address, "Claim " + claim.id, render("claim.html", data)});
}

} // namespace

std::vector<Judgement> decidedClaims(const std::vector<Record>& all) {
    std::vector<Judgement> judgements;
    for (const Claim& claim : claims()) judgements.push_back(judge(claim, all));
    const auto isDecided = [](const Judgement& judgement) {
        return judgement.verdict != Verdict::NotMeasured && judgement.verdict != Verdict::NotTestable;
    };
    if (std::ranges::none_of(judgements, isDecided)) return {};
    return judgements;
}

void addClaimPages(const std::vector<Judgement>& judgements, const std::vector<Record>& all,
                   const std::filesystem::path& images, SiteWriter& site) {
    std::map<Verdict, int> counts;
    for (const Judgement& judgement : judgements) {
        ++counts[judgement.verdict];
        addClaimPage(judgement, all, images, site);
    }
    std::vector<std::string> parts;
    for (const auto& [verdict, count] : counts) parts.push_back(fmt::format("{} {}", count, name(verdict)));
    Data data;
    data.set("title", fmt::format("{} claims of the papers", judgements.size()));
    data.set("described", fmt::format("Verdicts are computed from these records: {}.", fmt::join(parts, ", ")));
    data.set("chart", "");
    data.set("table", site.table("claims.html", board(judgements)));
    site.add({"claims.html", "Claims", render("chart-page.html", data)});
}

} // namespace shadowbench::site
