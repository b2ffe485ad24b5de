// What a compiler says of the machine code of a pipeline.
#pragma once

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

    /// 0 where the driver does not give it.
    [[nodiscard]] std::uint64_t of(const std::string& statistic) const;
};

/// As one line, and back; throws BadInput for a line that is none.
std::string toText(const std::vector<StageFigures>& figures);
std::vector<StageFigures> figuresOf(const std::string& text);

} // namespace shadowbench::gpu
