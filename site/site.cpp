#include "site/site.h"

#include "base/files.h"
#include "embedded_method.h"
#include "report/run_report.h"
#include "report/run_text.h"
#include "report/summary.h"
#include "site/made_file.h"
#include "site/menu.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace shadowbench::site {
namespace {

std::vector<Link> navigationOf(const Sources& sources, const std::vector<Record>& measured, const std::vector<Sweep>& sweeps,
                               bool claims) {
    std::vector<Link> links{{"Choose", chooseAddress}};
    if (std::ranges::any_of(measured, isExternal)) links.push_back({"Engines", enginesAddress});
    if (!sweeps.empty()) links.push_back({"Sweeps", "sweeps.html"});
    if (claims) links.push_back({"Claims", "claims.html"});
    if (!measured.empty()) links.push_back({"Truth", "truth.html"});
    if (sources.base) links.push_back({"Gate", "gate.html"});
    if (sources.findings) links.push_back({"History", "history.html"});
    return links;
}

/// The records of one seed of each scene, the first's: the others serve claims alone.
std::vector<Record> ofOneSeed(const std::vector<Record>& records) {
    std::map<std::string, std::uint32_t> seeds;
    std::vector<Record> kept;
    for (const Record& record : records)
        if (seeds.try_emplace(record.scene, record.seed).first->second == record.seed) kept.push_back(record);
    return kept;
}

/// Records of one scene that were measured at another profile or size than its first ones stand apart, as a scene of their
/// own: "basic, paper, 700²". Their errors and costs are not those of the others.
std::vector<Record> splitMixedRuns(std::vector<Record> records) {
    std::map<std::string, const Record*> firsts;
    std::vector<std::string> names;
    for (const Record& record : records) {
        const Record& first = *firsts.try_emplace(record.scene, &record).first->second;
        const bool same =
            std::tie(first.profile, first.width, first.height) == std::tie(record.profile, record.width, record.height);
        names.push_back(same ? record.scene : record.scene + sizeSuffix(record));
    }
    for (std::size_t i = 0; i < records.size(); ++i) records[i].scene = names[i];
    return records;
}

/// The records of techniques, or those of other renderers.
std::vector<Record> only(std::vector<Record> records, bool external) {
    std::erase_if(records, [&](const Record& record) { return isExternal(record) != external; });
    return records;
}

/// The records against older ones.
struct Comparison {
    gate::GateResult result;
    std::vector<ComparedCell> worse;

    [[nodiscard]] std::vector<RunCell> before() const {
        std::vector<RunCell> cells;
        for (const ComparedCell& cell : worse)
            if (cell.base) cells.push_back(*cell.base);
        return cells;
    }
};

Comparison comparisonOf(const Sources& sources) {
    if (!sources.base) return {};
    gate::GateResult result = gate::comparedRecords(*sources.base, sources.records);
    std::vector<ComparedCell> worse =
        worseCells(result.changes, {*sources.base, sources.baseImages}, {sources.records, sources.images});
    return {std::move(result), std::move(worse)};
}

} // namespace

std::filesystem::path writeSite(const Sources& sources, const std::filesystem::path& folder) {
    const std::vector<Record> shown = ofOneSeed(sources.records);
    std::vector<Record> measured = shown;
    std::erase_if(measured, [](const Record& record) { return record.sweep.has_value(); });
    const std::string command = measured.empty() ? "" : report::runCommand(measured);
    const std::size_t scenes = report::scenes(measured).size();
    measured = splitMixedRuns(std::move(measured));
    if (sources.standing) measured = report::standing(std::move(measured));
    const std::vector<Sweep> sweeps = sweepsOf(shown);
    const std::vector<Judgement> claims = decidedClaims(sources.records);
    SiteWriter site(folder, navigationOf(sources, measured, sweeps, !claims.empty()), sceneGroups(measured));

    const Comparison compared = comparisonOf(sources);
    writeCells(measured, sources.images, site, sources.sequences, compared.before()); // whose pictures other pages show, too
    const report::Written report = report::writeReport(measured, folder, sources.named);
    writeFile(folder / "results.csv", report::csv(sources.records));
    const bool engines = std::ranges::any_of(measured, isExternal);
    addIndexPage({measured, sources.images, command, scenes, engines, claims.size()}, site);
    addChoosePage(only(measured, false), sources.images, site);
    if (engines) addEnginesPage(only(measured, true), sources.images, site);
    for (const std::string& scene : report::scenes(measured))
        addScenePage(measured, scene, sources.images, report.charts, site);
    for (const Sweep& sweep : sweeps) addSweepPage(sweep, site);
    if (!sweeps.empty()) addSweepList(sweeps, site);
    if (!claims.empty()) addClaimPages(claims, sources.records, sources.images, site);
    if (!measured.empty()) addTruthPages(measured, sources.images, site);
    if (sources.base) {
        gate::GateOptions options;
        options.base = sources.baseName;
        addGatePage(compared.result, options, compared.worse, site);
    }
    if (sources.findings) addHistoryPage(*sources.findings, site);
    site.writeAssets();
    writeMade(folder / "docs/metrics.md", embedded::method().front().text);
    return folder / "index.html";
}

} // namespace shadowbench::site
