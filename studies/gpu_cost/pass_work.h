// What the passes of a frame do, joined from what a record counts and what the frame's shaders, targets and moves are.
#pragma once

#include "gpu/model.h"
#include "harness/records/record.h"
#include "studies/shader_cost/shader_cost.h"

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace shadowbench::gpucost {

/// The architecture whose figures of shaders stand for all cards.
inline constexpr const char* architecture = "navi21";

struct NamedWork {
    std::string pass; // as in records
    gpu::PassWork work;
};

/// The shaders and moves of one technique on one scene.
struct Drawn {
    std::vector<shaders::ShaderCost> shaders; // on `architecture`
    std::vector<shaders::FrameMove> moves;
    glm::ivec2 screen{}; // the image that was drawn
};

/// The records of one technique on one scene, by this program or by others, in the order in which they count.
using Cell = std::vector<const Record*>;

/// The passes that a record counts of a frame; of others than the standing one, none where it draws as that does.
const std::vector<PassRecord>& passesOf(const Record& record, shaders::CountedFrame frame);

/// What passes count on an image of `size` pixels, by the first record that says it: of one that counted on that size, else
/// of the straight line in the number of pixels through the two sizes nearest to it. Fragments of passes for which it counts
/// none are the next record's: a graphics processor runs no shader where depth alone is drawn. Throws BadInput where no
/// record has counted on two sizes.
std::vector<PassRecord> countsOn(const Cell& cell, glm::ivec2 size);

/// All passes of a frame; of others than the standing one, none where it draws as that does. Targets as large as the screen
/// that was drawn grow with it, all others do not. What another frame counts was counted on one size: a pass that the
/// standing frame has, too, grows as it does there, and of the others those that draw into targets that grow.
std::vector<NamedWork> worksOf(const Cell& cell, const Drawn& drawn, glm::ivec2 size,
                               shaders::CountedFrame frame = shaders::CountedFrame::Standing);

} // namespace shadowbench::gpucost
