// The quantities that a sweep moves. An axis changes a loaded scene, or parameters of techniques that state the same.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/entry.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// A parameter that states an axis' quantity.
struct AxisParameter {
    std::string techniques; // that have it: a glob over ids
    std::string name;

    /// Its value where the axis has `value`, of a technique with these parameters. Throws BadInput where there is none.
    /// Empty: the same value.
    std::function<double(double value, const techniques::Parameters& others)> of = {};
};

struct Axis {
    std::string id; // on the command line and in records
    std::string unit;
    std::string meaning;
    std::vector<double> values; // from harmless to hard, unless the user gives others
    bool logarithmic = false;   // how a chart draws it
    bool whole = false;         // values are whole numbers

    /// Sets the quantity on a scene whose light stands still. Throws BadInput naming what the scene lacks. Empty if
    /// techniques state it.
    std::function<void(Scene&, double)> move = {};

    /// The largest value that a scene can take. Empty if every scene can take them all.
    std::function<double(const Scene&)> most = {};

    /// What techniques state the quantity by; of a technique the first that it has.
    std::vector<AxisParameter> parameters = {};

    [[nodiscard]] bool isParameter() const { return !parameters.empty(); }

    /// Null if the technique states nothing of the kind.
    [[nodiscard]] const AxisParameter* parameterOf(const techniques::Variant& variant) const;

    /// The variant at `value` of an axis that it has a parameter of. Throws BadInput for a value that it does not take.
    [[nodiscard]] techniques::Variant at(const techniques::Variant& variant, double value) const;

    /// `values` as far as the scene can take them, and then its largest.
    [[nodiscard]] std::vector<double> valuesFor(const Scene& scene) const;
};

/// All axes, in the order they are listed.
std::span<const Axis> axes();

/// Throws BadInput with near matches.
const Axis& axisNamed(std::string_view id);

} // namespace shadowbench
