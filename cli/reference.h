// The parts of the verb `reference`: computing one, verifying and accepting the golden ones, reporting on the truth.
#pragma once

#include "base/error.h"
#include "harness/cells/truths.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

struct ReferenceOptions {
    std::vector<std::string> scenes; // ids or files; empty: the standard scenes
    Profile profile = Profile::Gate;
    std::string oracle = "auto";
    std::optional<int> frame; // default: the scored one, or all for golden references
    std::optional<Truth> truth;
    int samples = 0;       // 0: the scene's own
    bool polygons = false; // also exact polygons, as WKT and SVG
    int points = 4096;     // that certifyReference compares
    bool quiet = false;
    bool json = false;
    std::filesystem::path out = "results/latest/reference";
    std::filesystem::path golden = "results/reference";
    std::filesystem::path report; // empty: none is asked for
    std::filesystem::path cache;  // empty: the default; for the report only
};

/// The frame asked for, by default the scored one. Throws BadInput for one that the scene does not have.
int frameOf(const Scene& scene, const ReferenceOptions& options);

/// What is computed: the one scene's frame, oracle and samples. Throws BadInput unless one scene is named.
struct NamedRequest {
    std::string scene;
    int frame;
    groundtruth::Request request;
};
NamedRequest requestOf(const ReferenceOptions& options);

ExitCode computeReference(const ReferenceOptions& options);

/// Renders an area light or an environment with POV-Ray and prints its certificate; throws Inconclusive for a render that is
/// refused.
ExitCode certifyReference(const ReferenceOptions& options);
ExitCode verifyGoldenReferences(const ReferenceOptions& options);
ExitCode acceptGoldenReferences(const ReferenceOptions& options);
ExitCode reportOnTruth(const ReferenceOptions& options);

} // namespace shadowbench
