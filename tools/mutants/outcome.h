// What comparing records detects of a planted fault, and the report on all of them.
#pragma once

#include "tools/mutants/mutant.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::mutants {

struct Outcome {
    Mutant mutant;
    std::vector<gate::Change> worse; // than without the fault
    std::optional<double> slowdown;  // largest change of instructions, as a share of the base's

    [[nodiscard]] bool caughtInClass() const;
    [[nodiscard]] bool caught() const { return !worse.empty(); }
};

Outcome outcomeOf(const Mutant& mutant, const std::vector<Record>& base, const std::vector<Record>& head);

/// The change of the expected class that exceeds its allowance most; else that of any class; nothing if nothing is worse.
std::optional<gate::Change> strongest(const Outcome& outcome);

/// Markdown: shares caught over all and by class, a table of faults, one of slowdowns, survivors with their reasons.
/// `source` says what the records were made from.
std::string mutantsReport(const std::vector<Outcome>& outcomes, const std::string& source);

} // namespace shadowbench::mutants
