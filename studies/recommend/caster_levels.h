// The coarsest shadow casters that a scene needs: per object and distance band the level of detail, such that the whole
// shadow stays within tolerance of the finest levels' exact shadow (docs/metrics.md, "Adequacy").
#pragma once

#include "base/progress.h"
#include "studies/recommend/caster_groups.h"
#include "studies/recommend/shadow_error.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::recommend {

struct CasterOptions {
    std::vector<std::string> tolerance; // as parseTolerance takes them; empty: the scene's own
    std::vector<double> bands;          // empty: the scene's own
    Chains chains;                      // empty: the scene's own levels
    std::optional<int> frame;           // nothing: the scored one
    int lightSamples = 64;              // of the verification under an area light
};

/// What a group may cast at next, and the errors of the whole choice with that level.
struct CoarserLevel {
    std::size_t level;
    Errors errors, verified; // by the search's oracle and by the other one
};

/// A group's recommended level.
struct GroupLevel {
    std::string object;
    double from, until; // metres
    std::size_t instances;
    std::vector<std::size_t> chain;      // triangles of one instance at each level
    std::size_t level;                   // 0 is the finest
    std::optional<CoarserLevel> coarser; // nothing when the chain ends here

    [[nodiscard]] std::size_t triangles() const { return instances * chain[level]; }
};

struct CasterRecommendation {
    std::string scene, profile;
    int frame = 0;
    glm::ivec2 size{0, 0};
    Errors tolerance;
    std::size_t receiverPixels = 0, allReceiverPixels = 0; // counted; of the frame with objects that have levels

    std::vector<GroupLevel> groups;
    std::size_t triangles = 0, finestTriangles = 0, drawnTriangles = 0; // of all groups: recommended, finest, as drawn
    Errors errors, drawnErrors;                                         // of the recommended levels, and as drawn
    std::string oracle;                                                 // of the search
    std::size_t tried = 0, possible = 0;                                // choices of levels

    std::string verifier; // the other oracle
    Errors verifiedErrors;

    /// By the verifier the recommended levels are within tolerance and, for every group that has one, the next coarser level
    /// is not.
    bool verified = false;
};

/// Searches with one exact oracle and verifies with another: `rays` and `polygon` under a hard light, the exact visible
/// fraction (`area`) and rays from points of the light under an area light. Throws BadInput for a scene without levels, a
/// tolerance or receivers.
CasterRecommendation recommendCasters(const Scene& scene, const CasterOptions& options, const Progress& progress = {});

} // namespace shadowbench::recommend
