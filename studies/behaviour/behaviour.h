// What each technique is good at and where it fails, as its document says it: by which test this is asserted, and on which
// scene it can be seen, with which figure (behaviour.json beside this file).
#pragma once

#include "harness/records/record.h"

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

struct Asserted {
    std::string says;                   // in a few words
    std::string test;                   // "Suite.Name"; a suite with parameters without its prefix
    std::string scene, variant, metric; // of the record in the gate profile that shows it, as in Figure (studies/claims)
};

struct Behaviour {
    std::string technique; // id
    Asserted strength, failure;
};

/// One for each technique of the catalogue, in its order.
const std::vector<Behaviour>& behaviours();

/// Throws BadInput naming technique and key for what is no list of behaviours.
std::vector<Behaviour> parseBehaviours(std::string_view json);

/// What is seen, by which test, where, and the figure that `records` have for it: "–" where they have none. The variant is
/// named where it is not the technique's defaults.
std::vector<std::string> cellsOf(const std::string& technique, const Asserted& asserted, const std::vector<Record>& records);

enum class Markup { Markdown, Latex };

/// A row for each technique: its source, strength and failure, each with test, scene and the figure that `records` have for
/// it, "–" where they have none. LaTeX: a `longtable` with the rules of `booktabs`, to be put into a document.
std::string behaviourTable(const std::vector<Behaviour>& behaviours, const std::vector<Record>& records, Markup markup);

} // namespace shadowbench
