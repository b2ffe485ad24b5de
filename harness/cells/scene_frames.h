// A scene's frames as cells are scored on them: stage, truths, and what all cells of a frame share, made when first asked
// for.
#pragma once

#include "harness/cells/truths.h"
#include "harness/metrics/frames.h"
#include "harness/render/stage.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <utility>

namespace shadowbench {

class SceneFrames {
public:
    /// Both must outlive the object. Needs a GL context.
    SceneFrames(const Scene& scene, Truths& truths)
        : scene_(scene), truths_(truths), stage_(scene), scored_(scene.timeline.still - 1) {}
    explicit SceneFrames(Scene&&, Truths&) = delete;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    Truths& truths() { return truths_; }
    Stage& stage() { return stage_; }

    /// The last still frame.
    [[nodiscard]] int scored() const { return scored_; }

    /// Shows frame `index`. The still frames but the first two are alike.
    void show(int index);

    /// The truth of the frame that is shown. The still frames share one.
    const groundtruth::Reference& truth(Truth truth) { return truths_.at(truth, std::max(shown_, scored_)); }

    /// What the frame that is shown has in its G-buffer, read back when first asked for.
    const metrics::Drawn& drawn();

    /// The receivers of the frame that is shown, by that truth; valid as long as this object.
    const metrics::Mask& mask(Truth truth);

    /// From the frame that is shown, one of the moving ones, to the one before; valid as long as this object.
    const Image<glm::vec2>& warp(Truth truth);

    /// metrics::motion along that warp.
    double motion(Truth truth);

    /// The picture of the scored frame, which is shown when this is first asked for; and with its true shadows.
    const metrics::Shading& shading();
    const metrics::FlipPicture& truePicture(Truth truth);

private:
    const Scene& scene_;
    Truths& truths_;
    Stage stage_;
    int scored_;
    int shown_ = 0;
    std::optional<metrics::Drawn> drawn_; // of `shown_`
    std::map<std::pair<Truth, int>, metrics::Mask> masks_;
    std::map<std::pair<Truth, int>, Image<glm::vec2>> warps_;
    std::map<std::pair<Truth, int>, double> motions_;
    std::optional<metrics::Shading> shading_;
    std::map<Truth, metrics::FlipPicture> pictures_;
};

} // namespace shadowbench
