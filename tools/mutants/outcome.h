// What is detected of a planted fault, and the report on all of them.
#pragma once

#include "tools/mutants/mutant.h"
#include "tools/mutants/trial.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::mutants {

struct Outcome {
    Mutant mutant;
    std::vector<gate::Change> worse; // than without the fault
    std::optional<double> slowdown;  // largest change of instructions, as a share of the base's
    std::string refused;             // the sentence with which program, comparison, truth or test refused; "": none did

    [[nodiscard]] bool caughtInClass() const; // or by the means expected
    [[nodiscard]] bool caught() const { return !worse.empty() || !refused.empty(); }
    [[nodiscard]] bool asExpected() const { return mutant.benign ? !caught() : caughtInClass(); }
};

Outcome outcomeOf(const Mutant& mutant, const Trial& base, const Trial& head);

/// The change of the expected class that exceeds its allowance most; else that of any class; nothing if nothing is worse.
std::optional<gate::Change> strongest(const Outcome& outcome);

/// "caught", "elsewhere", "SURVIVES"; of a benign change "green", "FALSE RED".
std::string verdict(const Outcome& outcome);

/// Markdown: shares caught over all and by class, tables of faults, of slowdowns and of benign changes, and what did not end
/// as expected, with its reason.
/// `source` says what the records were made from.
std::string mutantsReport(const std::vector<Outcome>& outcomes, const std::string& source);

} // namespace shadowbench::mutants
