// The truth itself as pages: what the references show, how sure they are, whether oracles agree, how long they took.
#pragma once

#include "groundtruth/certify/agreement.h"
#include "groundtruth/contract/reference.h"
#include "report/run_report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::report {

struct ShownReference {
    std::string truth; // "hard", "soft", "pixel-area"
    groundtruth::Reference reference;
};

/// What a page says of one scene: the references of one frame, and how oracles agree on it.
struct TruthOfScene {
    std::string scene, title, shows; // id, title and first comment of the scene file
    std::string profile;
    int frame = 0;
    std::vector<ShownReference> references; // never empty, of one size
    std::vector<groundtruth::Agreement> agreements;
};

/// Writes report.md, a page <scene>.md with PNG images and an SVG of histograms for every scene, and seconds.svg; all links
/// are relative. Throws Inconclusive when gnuplot is missing or fails, InternalError when a file cannot be written.
Written writeTruthReport(const std::vector<TruthOfScene>& scenes, const std::filesystem::path& folder);

} // namespace shadowbench::report
