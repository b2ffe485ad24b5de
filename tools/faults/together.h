// Many verbs at once on one cache and one output.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace shadowbench::faults {

struct Together {
    int processes = 0;              // of each kind
    std::vector<std::string> facts; // a sentence each, with its figures
    std::vector<std::string> faults;
};

/// So many runs, scores, gates, merges, reports and prunes of the cache, at the same time. `show` is called with each fact
/// and fault as it is found, one at a time: on a busy machine the whole takes minutes.
Together workTogether(const std::filesystem::path& program, int processes,
                      const std::function<void(const std::string& sentence)>& show);

std::string togetherReport(const Together& together, const std::string& command);

} // namespace shadowbench::faults
