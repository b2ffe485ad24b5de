// What a compiler says of the machine code of a pipeline.
#pragma once

#include "gpu/machine_code.h"
#include "gpu/pipeline.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::gpu {

/// Of one stage: the statistics that the driver gives, in its order and by its names ("Instructions", "VGPRs", …), and the
/// width of its waves as "Subgroup size".
struct StageFigures {
    Stage stage;
    std::vector<std::pair<std::string, std::uint64_t>> statistics;
    double waves = 1;  // that hide each other's waits
    Busy guessed = {}; // by its machine code, each loop and branch as often as the compiler guesses

    /// 0 where the driver does not give it.
    [[nodiscard]] std::uint64_t of(const std::string& statistic) const;
};

/// As one line, and back; throws BadInput for a line that is none.
std::string toText(const std::vector<StageFigures>& figures);
std::vector<StageFigures> figuresOf(const std::string& text);

/// Likewise of what marks execute.
std::string toText(const std::vector<Busy>& marks);
std::vector<Busy> busyOf(const std::string& text);

} // namespace shadowbench::gpu
