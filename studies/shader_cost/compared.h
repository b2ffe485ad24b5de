// The shaders of two programs side by side: what `shader-cost --base` prints and the gate judges.
#pragma once

#include "studies/shader_cost/shader_cost.h"

#include <string>
#include <vector>

namespace shadowbench::shaders {

/// One shader in both programs, on one architecture.
struct SharedShader {
    const ShaderCost* before;
    const ShaderCost* after;

    /// Whether what waves execute was counted on both sides, as far as lines say in one frame.
    [[nodiscard]] bool isCounted() const;

    /// Whether their loops and branches are written otherwise (`?:` as `if`, or the reverse). The marks that count them then
    /// stand elsewhere, which by itself moves what is executed.
    [[nodiscard]] bool isRewritten() const;
};

/// Pointers into what was compared.
struct ComparedShaders {
    std::vector<SharedShader> both; // in the order of `after`
    std::vector<const ShaderCost*> gone, added;
};

/// Shaders are the same by their names. Of those that are left, one that is the only one of its variant with its stage and
/// file has another pass, and the only one of its pass and stage another file.
ComparedShaders compared(const ShaderCosts& before, const ShaderCosts& after);

/// The columns of the table: "instructions 726 → 731, VGPRs 48, waves 16 → 12, …".
std::string beforeAndAfter(const SharedShader& shader);

} // namespace shadowbench::shaders
