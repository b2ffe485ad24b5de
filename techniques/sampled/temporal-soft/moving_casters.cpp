#include "techniques/sampled/temporal-soft/moving_casters.h"

#include <vector>

namespace shadowbench::techniques {
namespace {

/// Of each placement, counted through the snapshot's batches in order.
std::vector<bool> moving(const Snapshot& snapshot) {
    std::vector<bool> result;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) result.push_back(batch.moves(placement));
    return result;
}

} // namespace

MovingCasters::MovingCasters(int side, Bias bias)
    : depth_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar), target_{&depth_},
      program_("shared/maps/depth_map.vert", "gl/depth_only.frag"), bias_(bias) {}

void MovingCasters::draw(const LightView& light, const Frame& frame) {
    const bool moves = frame.scene.moving();
    if (!moves && !drawn_) return;
    const auto pass = frame.pass("moving casters");
    target_.clearDepth(1);
    drawn_ = moves;
    if (!moves) return;
    target_.bind();
    const CasterPass casters(program_, light, bias_);
    frame.scene.draw(moving(frame.snapshot));
}

} // namespace shadowbench::techniques
