#include "harness/cells/scene_frames.h"

#include <algorithm>

namespace shadowbench {

void SceneFrames::show(int index) {
    stage_.show(index);
    shown_ = index;
    drawn_.reset();
}

const metrics::Drawn& SceneFrames::drawn() {
    if (!drawn_) drawn_ = stage_.drawn();
    return *drawn_;
}

const metrics::Mask& SceneFrames::mask(Truth kind) {
    const std::pair key(kind, std::max(shown_, scored_));
    if (const auto found = masks_.find(key); found != masks_.end()) return found->second;
    return masks_.emplace(key, metrics::receiverMask(truth(kind), drawn(), stage_.shown().camera.eye)).first->second;
}

const Image<glm::vec2>& SceneFrames::warp(Truth kind) {
    const std::pair key(kind, shown_);
    if (const auto found = warps_.find(key); found != warps_.end()) return found->second;
    const groundtruth::Reference& before = truths_.at(kind, shown_ - 1);
    return warps_.emplace(key, metrics::warp(stage_.shown(), scene_.size, truth(kind), before)).first->second;
}

double SceneFrames::motion(Truth kind) {
    const std::pair key(kind, shown_);
    if (const auto found = motions_.find(key); found != motions_.end()) return found->second;
    const Light before = snapshot(scene_, shown_ - 1).light;
    return motions_.emplace(key, metrics::motion(stage_.shown(), before, truth(kind), warp(kind))).first->second;
}

const metrics::Shading& SceneFrames::shading() {
    if (!shading_) shading_ = metrics::shading(stage_.shown(), drawn(), stage_.normals());
    return *shading_;
}

const metrics::FlipPicture& SceneFrames::truePicture(Truth kind) {
    if (const auto found = pictures_.find(kind); found != pictures_.end()) return found->second;
    const Image<glm::vec3> picture = metrics::shaded(shading(), truths_.at(kind, scored_).visibility);
    return pictures_.emplace(kind, metrics::flipPicture(picture)).first->second;
}

} // namespace shadowbench
