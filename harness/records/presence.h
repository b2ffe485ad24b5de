// Which results two sets of records should hold, and which of them are there on both sides.
#pragma once

#include "harness/records/record.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::gate {

/// What makes two records of different commits records of the same cell.
using CellKey = std::tuple<std::string, std::string, std::string, int, int, std::uint32_t, std::string, std::string, double>;
CellKey cellOf(const Record& record);

/// A technique's variant on a scene that the head must have, and the base, too, unless it does not know one of the two.
struct Expected {
    std::string scene, variant;
    bool isNew = false;
};

/// Results by name, "pcf on trees": a seed, a size and a step of a sweep each count.
struct Presence {
    std::size_t expected = 0, compared = 0;
    std::vector<std::string> isNew, gone, failed, repeated;
};

/// "108 of 110 expected results compared; new: pcf on trees; failed: esm on trees", without what there is none of.
std::string text(const Presence& presence);

/// A cell on both sides, once a seed; in the order of the head's seeds.
struct MatchedCell {
    std::vector<const Record*> base, head;

    /// Whether it holds for every seed.
    [[nodiscard]] bool is(bool (*predicate)(const Record&, const Record&)) const;
};

/// A record, or an expected result that neither side has, that is not compared.
struct Absence {
    std::string scene, variant;
    std::string what;   // the end of a sentence that begins with the two
    bool isNew = false; // no reason to compare it; everything else is one not to pass
};

struct Matched {
    std::vector<MatchedCell> cells; // scored on both sides, in the order of the head
    std::vector<Absence> absences;
    Presence presence;
};

/// Without `expected`, what either side holds is expected of both. A technique that is not applicable on both sides is not
/// expected; one that has become applicable is new.
Matched match(const std::vector<Record>& base, const std::vector<Record>& head,
              const std::optional<std::vector<Expected>>& expected);

} // namespace shadowbench::gate
