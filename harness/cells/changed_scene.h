// Copies of a scene that differ in one thing, on which rows are scored beside the scene itself.
#pragma once

#include "harness/cells/scene_frames.h"
#include "harness/cells/truths.h"
#include "scene/scene.h"

#include <utility>
#include <vector>

namespace shadowbench {

/// The frames of such a copy, of which the last still one is scored.
class ChangedScene {
public:
    /// The cache must outlive the object. Needs a GL context.
    ChangedScene(Scene scene, const groundtruth::Cache& cache)
        : scene_(std::move(scene)), truths_(scene_, cache), frames_(scene_, truths_) {}
    ChangedScene(const ChangedScene&) = delete;
    ChangedScene& operator=(const ChangedScene&) = delete;

    SceneFrames& frames() { return frames_; }

private:
    Scene scene_;
    Truths truths_;
    SceneFrames frames_;
};

/// By how much map and image grow for `run --neighbours`: a fortieth, too little to change what a method can do and enough
/// to move every texel and pixel.
constexpr int neighbourOf(int size) { return (size * 41 + 20) / 40; }

/// The scene with an image of `neighbourOf` its size. Nothing moves.
Scene withNeighbourImage(Scene scene);

/// The scene from `count` − 1 other views, for `run --views`: the eye turned about the vertical through what it looks at, by
/// 10° to either side, then 20°, and so on. Nothing moves.
std::vector<Scene> otherViews(const Scene& scene, int count);

} // namespace shadowbench
