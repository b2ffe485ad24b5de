// One scene on the GPU at its image size: shows a frame and lets techniques render it.
#pragma once

#include "harness/metrics/frames.h"
#include "scene/scene.h"
#include "techniques/contract/technique.h"

#include <vector>

namespace shadowbench {

class Stage {
public:
    /// The scene must outlive the stage.
    explicit Stage(const Scene& scene);
    explicit Stage(Scene&&) = delete;

    /// Uploads frame `index` of the scene and draws its G-buffer.
    void show(int index);

    /// Uploads a snapshot of the scene and draws its G-buffer.
    void show(const Snapshot& snapshot);
    [[nodiscard]] const Snapshot& shown() const { return snapshot_; }

    /// Lets other casters stand in the shown frame, of which the G-buffer stays, until another is shown.
    void cast(const std::vector<Batch>& casters);

    /// The shown frame as number `index` of a technique's sequence (which seeds its jitter), until another is shown.
    [[nodiscard]] techniques::Frame frame(int index, std::uint32_t seed, techniques::PassListener* passes = nullptr) const;

    /// Draws the G-buffer of the shown frame again (the least that any technique's frame costs), as the pass "G-buffer".
    void redraw(techniques::PassListener* passes = nullptr);

    /// What the G-buffer of the shown frame holds.
    [[nodiscard]] metrics::Drawn drawn() const;

    /// Its geometric normals, on the side that is seen; anything for background.
    [[nodiscard]] Image<glm::vec3> normals() const;

    /// Renders `frame(index, seed, passes)`.
    void render(techniques::Technique& technique, int index, std::uint32_t seed, techniques::PassListener* passes = nullptr);

    /// The visibility image of the last `render`.
    [[nodiscard]] Image<float> visibility() const;

private:
    const Scene& scene_;
    Snapshot snapshot_;
    Light hardLight_;
    gl::SceneBuffers buffers_;
    gl::GBuffer gbuffer_;
    gl::Texture visibility_;
    gl::RenderTarget target_;
};

} // namespace shadowbench
