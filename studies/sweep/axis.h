// The quantities that a sweep moves. An axis changes a loaded scene, or is a parameter of techniques.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

struct Axis {
    std::string id; // on the command line and in records
    std::string unit;
    std::string meaning;
    std::vector<double> values; // from harmless to hard, unless the user gives others
    bool logarithmic = false;   // how a chart draws it
    bool whole = false;         // values are whole numbers

    /// Sets the quantity on a scene whose light stands still. Throws BadInput naming what the scene lacks. Empty if the axis
    /// is the techniques' parameter of the same name.
    std::function<void(Scene&, double)> move;

    /// The largest value that a scene can take. Empty if every scene can take them all.
    std::function<double(const Scene&)> most = {};

    [[nodiscard]] bool isParameter() const { return !move; }

    /// `values` as far as the scene can take them, and then its largest.
    [[nodiscard]] std::vector<double> valuesFor(const Scene& scene) const;
};

/// All axes, in the order they are listed.
std::span<const Axis> axes();

/// Throws BadInput with near matches.
const Axis& axisNamed(std::string_view id);

} // namespace shadowbench
