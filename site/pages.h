// The pages of a site, a function each. All take records without those of sweeps unless they say otherwise.
#pragma once

#include "history/history_report.h"
#include "site/gate_page.h"
#include "site/site_writer.h"
#include "studies/claims/claims.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::site {

inline constexpr const char *chooseAddress = "choose.html", *enginesAddress = "engines.html";

/// What a site shows, for its first page.
struct Contents {
    const std::vector<Record>& records;
    std::filesystem::path images = {};
    std::string command = {}; // that made the records
    std::size_t scenes = 0;   // at whatever size
    bool engines = false;     // has a page of them
    std::size_t claims = 0;   // that have pages
};

/// index.html, after the pages of cells and the charts, which it shows.
void addIndexPage(const Contents& contents, SiteWriter& site);

/// choose.html: which technique to take on each scene; every technique on every scene. Of techniques alone.
void addChoosePage(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site);

/// engines.html: other renderers' records; and engines/<engine>.html, a page for each engine.
void addEnginesPage(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site);

/// scenes/<scene>.html; `drawn`: the charts that the report has written into the site's folder.
void addScenePage(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images,
                  const std::vector<std::filesystem::path>& drawn, SiteWriter& site);

/// The records of one sweep: those of one scene over one axis.
struct Sweep {
    std::string scene, axis;
    std::vector<Record> records;
};
std::vector<Sweep> sweepsOf(const std::vector<Record>& records);
std::string sweepAddress(const Sweep& sweep); // "sweeps/simple-light-size.html"

void addSweepPage(const Sweep& sweep, SiteWriter& site);
/// sweeps.html: all of them, and where techniques break.
void addSweepList(const std::vector<Sweep>& sweeps, SiteWriter& site);

/// Every claim's verdict by `all` records, those of sweeps included; empty where they decide none.
std::vector<Judgement> decidedClaims(const std::vector<Record>& all);

/// claims.html and a page for each claim.
void addClaimPages(const std::vector<Judgement>& judgements, const std::vector<Record>& all,
                   const std::filesystem::path& images, SiteWriter& site);

/// truth.html: the truths that records were scored against; a page for each scene.
void addTruthPages(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site);

/// history.html
void addHistoryPage(const history::Findings& findings, SiteWriter& site);

/// Copies a picture that `run --images` has left into the site; its address from the site's folder, "" where there is none.
std::string picture(const std::filesystem::path& images, const Record& record, const std::string& name,
                    const SiteWriter& site);

} // namespace shadowbench::site
