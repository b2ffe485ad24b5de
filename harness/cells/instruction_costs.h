// Fills in the instructions of scored records: Valgrind processes in parallel, several cells each.
#pragma once

#include "harness/records/record.h"
#include "scene/scene.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace shadowbench {

struct InstructionOptions {
    std::map<std::string, std::string> scenes; // by id: what loads the scene, an id or a file
    Profile profile = Profile::Gate;
    bool quiet = false;
};

/// Sets `cost.instructions` and `environment.valgrind` of every scored record that has no instructions yet. `onCounted` is
/// called on the calling thread's behalf, never twice at once, each time some more are filled in. A cell that fails under
/// Valgrind becomes an error record, never one without a count. Throws Inconclusive when there is no Valgrind.
void countInstructions(std::vector<Record>& records, const InstructionOptions& options,
                       const std::function<void()>& onCounted);

} // namespace shadowbench
