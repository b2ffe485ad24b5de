// What the gate judges beside the comparison with its base, as data: gate/bounds.toml.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench {
class TomlValue;
}

namespace shadowbench::gate {

/// Techniques on one scene; patterns as `run --technique` takes them.
struct GateRule {
    std::string scene;                    // id
    std::vector<std::string> techniques;  // variants, or globs over ids
    std::vector<std::string> except = {}; // these of them are left out
    std::string reason;

    /// Whether a technique's variant, by its canonical name, is meant.
    [[nodiscard]] bool covers(const std::string& variant) const;

    /// Whether it is left out, as a variant or with all of its technique.
    [[nodiscard]] bool excludes(const std::string& variant) const;

    /// Canonical names of the variants that are named one by one, not by a glob.
    [[nodiscard]] std::vector<std::string> named() const;
};

/// A score that a technique must keep on a scene, whatever the base does.
struct BoundRule {
    GateRule cells;
    Bound bound;
};

/// A curve whose break points are compared.
struct SweepRule {
    GateRule cells;
    std::string axis;
    std::vector<double> values; // empty: the axis' own
};

/// A change for the worse, or a result that is gone, that is accepted until a day.
struct Waiver {
    std::string scene;                   // id, or a glob over ids
    std::vector<std::string> techniques; // as GateRule has them, also of techniques that no longer exist
    std::string what;                    // the class of change: "leak", "status" of what is not compared …
    std::string reason, expires;         // "2026-12-31": the last day on which it holds

    [[nodiscard]] bool covers(const std::string& scene, const std::string& variant) const;
};

/// Seeds that a cell is measured with where chance plays a part: as many as the allowance for it counts on
/// (harness/records/compare.cpp).
inline constexpr std::uint32_t seedsOfChance = 8;

struct GateConfig {
    std::vector<GateRule> scenes; // judged beside the standard ones when the user names none
    std::vector<BoundRule> bounds;
    std::vector<SweepRule> sweeps;
    std::vector<GateRule> counted; // instructions
    std::vector<GateRule> timed;   // in pairs
    std::vector<GateRule> seeds;   // measured with several seeds, for what chance does to them
    std::vector<GateRule> choices; // every two choices of their parameters together; the scene is a file beside the bounds
    std::vector<Waiver> waivers;

    /// Whether chance plays a part in a variant, by its canonical name, on a scene.
    [[nodiscard]] bool isByChance(const std::string& scene, const std::string& variant) const;

    /// Scenes that are neither built in nor among `known`: misspelt, or a user's own.
    [[nodiscard]] std::vector<std::string> unknownScenes(const std::vector<std::string>& known) const;
};

/// Throws BadInput, with file and line, for what is no such file: unknown keys, metrics, axes or techniques, a missing
/// reason. A scene may be one that only its user has: see `unknownScenes`.
GateConfig readGateConfig(const std::filesystem::path& file, Profile profile);

/// The same of its text; `file` is its name in errors.
GateConfig parseGateConfig(const std::string& text, const std::string& file, Profile profile);

/// Bounds and waivers alone, of a file that says other things beside them.
GateConfig readJudgements(const TomlValue& root);

} // namespace shadowbench::gate
