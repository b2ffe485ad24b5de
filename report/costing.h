// In what the costs of a scene's rows are shown and compared: measured here, or modelled on a graphics card
// (docs/gpu-cost.md).
#pragma once

#include "report/summary.h"

#include <string>
#include <vector>

namespace shadowbench::report {

struct Costing {
    CostOf of;       // the dearer of the standing frame and the one in motion
    CostOf standing; // the standing frame alone
    std::string meaning;
    std::string unit;  // behind a number: "×", "ms"
    std::string card;  // as records name card and size (Record::modelled); "" where costs are measured here
    double spread = 0; // of what is modelled, as FrameCost::spread: advice names rows that are as cheap within it
};

/// Frames of sm-uniform.
Costing measuredHere(const std::vector<Record>& records, const std::string& scene);

/// Milliseconds on a card of images of one size, by its name in records. Rows that wait for the program, whose wait the
/// model does not know, have none.
Costing modelledOn(const std::string& name);

/// The cards and sizes that records of `scene` are modelled on, each once: "gtx-1080@1920x1080".
std::vector<std::string> modelledNames(const std::vector<Record>& records, const std::string& scene);

/// Modelled on the first of these, where there is one: techniques are made for graphics cards. Else measured here.
Costing shownCosting(const std::vector<Record>& records, const std::string& scene);

/// What the name of its chart begins with: "pareto", "modelled-gtx-1080-1920x1080".
std::string chartName(const Costing& costing);

/// "gtx-1080 at 1920×1080".
std::string cardAndSize(const std::string& name);

} // namespace shadowbench::report
