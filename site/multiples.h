// What techniques cost as multiples of sm-uniform, which can be compared over scenes.
#pragma once

#include "report/costing.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

/// Modelled on a card where any scene's records are, else measured here. The records must outlive it.
class Multiples {
public:
    explicit Multiples(const std::vector<Record>& records);

    /// Of the record's scene, the dearer of standing and in motion; nothing where no cost of such a kind is known.
    [[nodiscard]] std::optional<double> of(const Record& record) const;

    /// The geometric mean of the variant's over `scenes`, those without one left out.
    [[nodiscard]] std::optional<double> mean(const std::string& variant, const std::vector<std::string>& scenes) const;

    /// "modelled on gtx-1080 at 1920×1080", "measured here".
    [[nodiscard]] std::string where() const;

private:
    const std::vector<Record>& records_;
    report::Costing costing_;
    std::map<std::string, double> uniform_; // of sm-uniform, by scene
};

} // namespace shadowbench::site
