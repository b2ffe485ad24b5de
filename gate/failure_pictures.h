// Pictures of the cells that a gate found worse.
#pragma once

#include "gate/gate.h"
#include "gate/judged_cells.h"

namespace shadowbench::gate {

/// Where they go, under the folder of the report; whoever begins a report empties it.
std::filesystem::path pictureFolder(const std::filesystem::path& out);

/// Has both programs (`base` may be absent) draw the cells of the Worse changes, at most a dozen: visibility, reference and
/// error as EXR and PNG in `head` and `base` of its folder. Changes of cost need no picture. What other renderers draw is
/// left to copyFailures.
std::vector<FailurePictures> drawFailures(const std::vector<Change>& changes, const JudgedCells& judged,
                                          const MeasuredProgram* base, const MeasuredProgram& head,
                                          const std::filesystem::path& out, const Progress& progress);

/// What one side has drawn already.
struct DrawnSide {
    const std::vector<Record>& records;
    std::filesystem::path images; // as `run` keeps them
};

/// The same of two runs that have kept their pictures, or one of them.
std::vector<FailurePictures> copyFailures(const std::vector<Change>& changes, const DrawnSide& base, const DrawnSide& head,
                                          const std::filesystem::path& out);

} // namespace shadowbench::gate
