// What building and running a program with a fault in it gave, kept in files.
#pragma once

#include "studies/shader_cost/shader_cost.h"
#include "tools/mutants/mutant.h"
#include "tools/mutants/tree_copy.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::mutants {

/// Records, or figures of shaders, or the sentence with which program, truth or test refused; "": they did not.
struct Trial {
    std::vector<Record> records;
    std::string refused;
    shaders::ShaderCosts shaders = {};
};

/// Trials on one copy of the tree. Each is kept in a file named by what it hangs on, so a stopped suite goes on where it
/// stopped, shards on one machine share a folder of results, and those of several machines are joined by copying.
class Trials {
public:
    /// `kept` is the folder of results. The copy of the tree is made, and built, when a trial is missing.
    Trials(const TreeCopy& tree, std::filesystem::path kept);

    [[nodiscard]] bool hasBase(const Mutant& mutant) const;
    [[nodiscard]] bool has(const Mutant& mutant) const;

    /// Builds and runs the program without the fault. Throws InternalError when it refuses.
    void makeBase(const Mutant& mutant) const;

    /// Plants the fault, builds, runs and takes it out again. Throws InternalError, naming the mutant, when it does not
    /// build.
    void make(const Mutant& mutant) const;

    [[nodiscard]] Trial base(const Mutant& mutant) const;
    [[nodiscard]] Trial of(const Mutant& mutant) const;

private:
    [[nodiscard]] std::string key(const Mutant& mutant) const;
    [[nodiscard]] std::filesystem::path baseFile(const Mutant& mutant) const;
    [[nodiscard]] std::filesystem::path file(const Mutant& mutant) const;
    [[nodiscard]] Trial run(const Mutant& mutant) const;
    [[nodiscard]] Trial runProgram(const Mutant& mutant) const;
    [[nodiscard]] Trial runShaderCost(const Mutant& mutant) const;

    const TreeCopy& tree_;
    std::filesystem::path kept_;
    std::string layers_;
};

} // namespace shadowbench::mutants
