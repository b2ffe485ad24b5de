// Which technique to take on a scene, and why.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

struct Choice {
    std::optional<std::size_t> take; // index in the records; nothing if no technique was scored
    bool adequate = false;           // within the scene's tolerances
    std::string why;                 // "cheapest of 12 within tolerance"
    std::vector<std::size_t> others; // that are within the tolerances too, by cost
    std::vector<std::string> notes;  // report::notesOn
};

/// Indices of the scene's scored records that may be taken: not `none`, other renderers and techniques that lack what is
/// usually needed.
std::vector<std::size_t> suitedOn(const std::vector<Record>& records, const std::string& scene);

/// The cheapest technique within all tolerances of the scene; where none was timed, the one that errs least of those within;
/// where none is within, the one that comes nearest. `none`, other renderers
/// and techniques that lack what is usually needed (techniques/contract/need.h) do not count.
Choice choiceFor(const std::vector<Record>& records, const std::string& scene);

/// report::errorText of a scored record, "–" of another.
std::string errorText(const Record& record);

} // namespace shadowbench::site
