// What must hold of a technique's row on any scene: small images of scenes at the end of what there is.
#pragma once

#include "techniques/contract/entry.h"

#include <functional>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct RowCheck {
    std::string what;
    /// Draws with the GL context that is current. What is wrong, or nothing. Throws what making and drawing the technique
    /// throws.
    std::function<std::string()> draw;
};

/// The checks of a technique: those of each of its rows, then each parameter at both ends of its range and at each choice.
std::vector<RowCheck> rowChecks(const techniques::Entry& entry);

} // namespace shadowbench::gate
