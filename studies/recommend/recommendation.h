// The least that a scene needs within its tolerance: `shadowbench recommend`.
#pragma once

#include "base/error.h"
#include "report/advice.h"
#include "report/summary.h"
#include "studies/causes/explanation.h"
#include "studies/recommend/caster_levels.h"
#include "studies/recommend/least_resource.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shadowbench::recommend {

enum class Question { Casters, Technique, Map, Samples };
std::string_view name(Question question);
Question questionNamed(std::string_view word); // throws BadInput naming all

struct RecommendOptions {
    std::vector<std::string> scenes; // ids or files; empty: those standard scenes that have what is asked for
    std::set<Question> questions;    // empty: casters of a scene with levels; of others technique, and the map that it needs
    Profile profile = Profile::Gate;
    CasterOptions casters;                           // its tolerance holds for all questions
    std::vector<std::string> techniques;             // variants or globs; empty: all
    std::filesystem::path records;                   // of a run; empty: the cells that the questions need are run
    std::filesystem::path out = "results/recommend"; // of those cells' records
    std::filesystem::path cache;
    std::string card;      // costs are modelled on it, of images of 1920 × 1080; "": as the records say
    bool standing = false; // light and casters stand still: moving ones are not needed
    std::set<techniques::Need> needs = techniques::usualNeeds(); // of the technique
    bool quiet = false;
};

/// The cheapest technique within tolerance that can do what is needed.
struct Cheapest {
    std::string variant;
    double error;          // by the first tolerance's metric
    double cost;           // of the card in ms, else in frames of sm-uniform: the dearer of standing and in motion
    bool moving;           // false: of the standing frame alone
    std::string card = {}; // on which it is modelled, as records name it; "": measured here
};

/// Answers for one scene; what was not asked for is empty.
struct Recommendation {
    std::string scene;
    std::set<Question> questions;
    std::optional<CasterRecommendation> casters;
    std::vector<report::Tolerance> tolerances; // of the three below, which are within all of them
    std::optional<Cheapest> technique;         // nothing if none is within tolerance
    std::vector<std::string> techniqueNotes;   // what a person should know beside it
    std::vector<Least> maps, samples;          // a line a technique, the least first; empty if none is within tolerance
    std::optional<causes::Explanation> left;   // of the technique's error, or of the least where none is within tolerance
};

/// Inconclusive when a casters' recommendation was not verified, else that of a cell that ended in an error, else Pass.
struct Recommendations {
    std::vector<Recommendation> scenes;
    std::optional<report::CommonAdvice> common =
        {}; // the one technique for all, of several scenes; nothing if there is none
    ExitCode code = ExitCode::Pass;
};

Recommendations recommend(const RecommendOptions& options);

} // namespace shadowbench::recommend
