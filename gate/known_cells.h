// Results of a head that are its base's, for nothing that can decide them has changed (gate/reach.h).
#pragma once

#include "gate/measured_program.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// Whether both programs give the same for a variant on a scene. Of builds that do not say what decides it: no.
bool isKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::string& variant,
             const std::string& scene);

class KnownCells {
public:
    /// `measured`: of `steps` of the base.
    KnownCells(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::vector<Step>& steps,
               const Measured& measured);

    struct Split {
        std::vector<Step> steps; // that must be run, with what is known left out of their techniques, but for the sample
        std::size_t known = 0, sampled = 0, reached = 0; // variants of steps; the sample is among those that are known
    };
    /// Every 32nd known result, one at least, is measured all the same: which, a hash of the head's commit draws.
    [[nodiscard]] Split split(const std::vector<Step>& steps) const;

    /// The first known result that was measured and is another one, as "pcf on trees": whatever is not of the program but
    /// instructions, of which the comparison knows what is no change.
    [[nodiscard]] std::optional<std::string> contradicted(const std::vector<Step>& ran, const Measured& measured) const;

    /// All records of a step in the order of its techniques: those of `measured`, and the base's as the head's.
    [[nodiscard]] std::vector<Record> whole(const Step& step, const std::vector<Step>& ran, const Measured& measured) const;

private:
    using Records = std::map<std::string, std::vector<Record>>; // by technique
    [[nodiscard]] const std::vector<Record>* find(const Step& step, const std::string& technique) const;

    std::optional<BuildInfo> head_;
    std::map<std::string, Records> known_; // by step
};

} // namespace shadowbench::gate
