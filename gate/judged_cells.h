// Which cells a gate judges, and the runs of a program that measure them.
#pragma once

#include "gate/gate.h"
#include "gate/paired_run.h"
#include "gate/policy.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct JudgedScene {
    std::string id;
    std::string argument; // of `--scene`: the id, or an absolute path
    std::string content;  // of the file; empty for a built-in scene
    std::string truths;   // their keys: what a kept record was scored against must be what is scored against now
    std::vector<std::string> variants; // that are judged there, by their canonical names
    bool isBeside = false;             // judged beside the scenes that are named or standard
};

struct JudgedCells {
    Policy policy;
    std::vector<JudgedScene> scenes;
    std::vector<std::string>
        loosened;             // sentences: what the base judges more strictly, and the base's policy now judges here
    std::vector<Change> gone; // what the base judges and this build cannot
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;

    /// The cells that `options` choose, by the policy of their file of bounds and by that of a base, which shows
    /// `baseVariants` when all are asked for. Throws BadInput for an unknown scene or technique, Inconclusive without a file
    /// of bounds.
    explicit JudgedCells(const GateOptions& options, const std::optional<Policy>& base = {},
                         const std::vector<std::string>& baseVariants = {});

    /// The runs that measure all cells whose scene and variant `program` has. With `instructions`, the instructions of those
    /// that the config names are counted, or of all when it names none of the scenes.
    [[nodiscard]] std::vector<Step> steps(const MeasuredProgram& program, bool instructions) const;

    /// The runs in which this program calls the renderers that are not ours, for MeasuredProgram::run: one for all scenes
    /// that are judged with the same.
    [[nodiscard]] std::vector<Step> externalSteps() const;

    /// Cells that both programs have and whose time is compared: those that the config names, or all when it names none
    /// of the scenes.
    [[nodiscard]] std::vector<TimedCell> timedCells(const MeasuredProgram& base, const MeasuredProgram& head) const;

    /// Leaves out cells; how many. Their scenes stay, for the policy's rules mean them.
    std::size_t leaveOut(const std::function<bool(const JudgedScene& scene, const std::string& variant)>& isOut);

    [[nodiscard]] bool chooses(const std::string& scene, const std::string& variant) const;

    /// What the head must have; new is what `base` does not know. Without one, a file of records is the base.
    [[nodiscard]] std::vector<Expected> expected(const MeasuredProgram* base) const;

private:
    std::vector<std::filesystem::path> externalFiles_;

    [[nodiscard]] std::vector<std::string> chosenVariants(const GateOptions& options,
                                                          const std::vector<std::string>& baseVariants);
    /// Judges these variants, too; `argument` as --scene takes it.
    void addScene(const std::string& argument, std::vector<std::string> variants, bool isBeside);
    void addChoices(const GateOptions& options, const std::vector<std::string>& chosen);
    /// Variants of chosen techniques that a rule names and nobody shows, on scenes that are judged.
    void addNamed(const GateRule& rule, const std::vector<std::string>& chosen);
    void addSteps(const MeasuredProgram& program, const JudgedScene& scene, bool instructions,
                  std::vector<Step>& steps) const;
};

} // namespace shadowbench::gate
