// Which technique a scene needs: the cheapest whose errors a viewer accepts, of those that can do what is needed.
#pragma once

#include "harness/records/record.h"
#include "report/summary.h"
#include "techniques/contract/need.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shadowbench::report {

using techniques::Need;

/// The needs that the record's technique has no right answer for. Empty for one that the catalogue lacks.
std::set<Need> lackedOf(const Record& record, const std::set<Need>& needs);

/// Indices of the scene's records, by their costs as shown (report/costing.h). Those of `none`, which draws no shadow, are
/// in no list.
struct Advice {
    std::vector<std::size_t> within;    // tolerance, and suited to the needs: by cost, untimed ones last, by error
    std::vector<std::size_t> unsuited;  // within tolerance, but they lack something that is needed
    std::vector<std::size_t> uncertain; // of `within`: timed, but so unsteadily that their rank by cost says nothing
    std::vector<std::size_t> external;  // within tolerance, of other renderers: what they cost is not measured here
    std::optional<std::size_t> take;    // the first of `within` that is timed and not uncertain
    std::vector<std::size_t> asCheap;   // of `within`: dearer than `take`, but not beyond both intervals
    bool fitsNoFrame = false; // `take`, and so all of `within` that are modelled, take longer than a frame at 60 Hz
};
Advice adviceFor(const std::vector<Record>& records, const std::string& scene,
                 const std::set<Need>& needs = techniques::usualNeeds());

/// What a person should know of the advice beside `take`, a line each: that it is too dear for a frame, unsuited rows with
/// what they lack, rows that are as cheap as the times tell, rows whose times are too uncertain.
std::vector<std::string> notesOn(const Advice& advice, const std::vector<Record>& records, const std::set<Need>& needs);

/// One variant for several scenes.
struct CommonAdvice {
    std::string variant;
    std::string dearest;   // the scene where it costs most
    double cost = 0;       // there: ms on the card, else frames of sm-uniform
    std::string card = {}; // on which costs of all scenes are modelled, as records name it; "" where they are measured here
};

/// The variant that is within tolerance on every scene, and whose cost on its dearest scene is the least. Nothing if none
/// is.
std::optional<CommonAdvice> commonAdvice(const std::vector<Record>& records, const std::vector<std::string>& scenes,
                                         const std::set<Need>& needs = techniques::usualNeeds());

} // namespace shadowbench::report
