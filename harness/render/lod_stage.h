// The frames of a walk through a scene on the GPU: shows one and lets level-of-detail techniques draw it.
#pragma once

#include "harness/metrics/lod.h"
#include "harness/render/walk.h"
#include "scene/scene.h"
#include "techniques/contract/lod_technique.h"
#include "techniques/lod/level_drawer.h"
#include "techniques/lod/transition_mask.h"

namespace shadowbench::lod {

class LodStage {
public:
    /// Pictures of `size` pixels. The scene must outlive the stage and have a walk.
    LodStage(const Scene& scene, glm::ivec2 size);

    /// Makes frame `index` of the walk the one that is rendered, or its levels under the camera of frame 0 (standingFrame).
    void show(int index);
    void showStanding(int index);
    [[nodiscard]] const WalkFrame& shown() const { return shown_; }

    void render(techniques::LodTechnique& technique, techniques::PassListener* passes = nullptr);

    /// What the last `render` drew.
    [[nodiscard]] metrics::ColourImage picture() const;

    /// Ids of the instances in transition that the shown frame's pixels see, else 0.
    [[nodiscard]] Image<unsigned> transitionMask();

private:
    [[nodiscard]] techniques::LodFrame frame(techniques::PassListener* passes = nullptr);

    const Scene& scene_;
    glm::ivec2 size_;
    std::vector<techniques::LodChain> chains_;
    techniques::LevelDrawer drawer_;
    gl::Texture colour_, depth_;
    gl::RenderTarget target_;
    techniques::TransitionMask mask_;
    WalkFrame shown_;
};

} // namespace shadowbench::lod
