// Pictures of the cells that a gate found worse.
#pragma once

#include "gate/gate.h"
#include "gate/judged_cells.h"

namespace shadowbench::gate {

/// Has both programs (`base` may be absent) draw the cells of the Worse changes, at most a dozen: visibility, reference and
/// error as EXR and PNG under <out>/head and <out>/base. What an earlier gate left there is removed. Changes of cost need no
/// picture.
std::vector<FailurePictures> drawFailures(const std::vector<Change>& changes, const JudgedCells& judged,
                                          const MeasuredProgram* base, const MeasuredProgram& head,
                                          const std::filesystem::path& out, const Progress& progress);

/// What one side has drawn already.
struct DrawnSide {
    const std::vector<Record>& records;
    std::filesystem::path images; // as `run` keeps them
};

/// The same of two runs that have kept their pictures.
std::vector<FailurePictures> copyFailures(const std::vector<Change>& changes, const DrawnSide& base, const DrawnSide& head,
                                          const std::filesystem::path& out);

} // namespace shadowbench::gate
