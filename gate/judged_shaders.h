// Figures of shaders of base and head, which are exact: they are judged before anything is drawn (docs/gate.md, "Shaders").
#pragma once

#include "base/progress.h"
#include "gate/measured_program.h"
#include "harness/records/compare.h"
#include "studies/shader_cost/shader_cost.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct ShaderJudgement {
    std::vector<Change> changes;          // one for each shader of each variant that both sides have
    std::vector<std::string> notCompared; // sentences: what could not be judged, and why
    std::vector<std::string> notes;       // sentences: what there is nothing to compare with
};

/// A shader is Worse where on any architecture it has fewer waves, more spills or 0.5 % more cycles: of what waves execute,
/// where that was counted in one frame on both sides, else of the compiler's estimate. Unclear are more cycles of the same
/// machine code from loops and branches that are written otherwise. Better is the reverse of one of them, where none is
/// worse.
ShaderJudgement judgeShaders(const shaders::ShaderCosts& base, const shaders::ShaderCosts& head);

/// The same of two programs, which draw what is not kept: of these variants, all if there are none. Leaves their lines in
/// folders `base` and `head` of `out`.
ShaderJudgement judgeShaders(const MeasuredProgram& base, const MeasuredProgram& head,
                             const std::vector<std::string>& variants, const std::filesystem::path& out,
                             const Progress& progress);

/// One change a shader and direction, the worst of them, which names the other variants; what is not of shaders stays.
std::vector<Change> oneAShader(std::vector<Change> changes);

} // namespace shadowbench::gate
