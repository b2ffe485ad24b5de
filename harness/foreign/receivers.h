// Which pixels of another renderer's images are scored: those where it saw what the truth says is there.
#pragma once

#include "harness/cells/scene_frames.h"
#include "harness/foreign/foreign_row.h"
#include "harness/foreign/visibility.h"

#include <map>
#include <optional>
#include <utility>

namespace shadowbench::foreign {

/// What a hit mask (> ½: something) or a depth image says was drawn, in the terms of `metrics::receiverMask`: of a hit the
/// surface that the truth has there, if there is one. Either may be null.
metrics::Drawn drawnBy(const groundtruth::Reference& truth, const Camera& camera, const Image<float>* hits,
                       const Image<float>* depth, Depth kind);

/// 1 where one of the eight pixels around shows another surface, one that faces the light where this does not, or the same
/// one in front or behind: what renderers that do not look through the pixel's centre alone see more than one of.
Pixels geometryEdges(const groundtruth::Reference& truth, const Camera& camera);

/// The pixels of `mask` of which `without` is 0; what was found out about primary hits stays.
metrics::Mask withoutPixels(const metrics::Mask& mask, const Pixels& without);

/// The receivers of a row, frame by frame. Without a hit mask and a depth image they are those of this program's own
/// rasteriser, which every renderer with the same camera shares but for pixels at geometry's edges.
class RowReceivers {
public:
    /// Both must outlive the object.
    RowReceivers(SceneFrames& frames, const ForeignRow& row) : frames_(frames), row_(row) {}

    /// Goes on to a frame, which `frames` shows. Throws BadInput for files that cannot be read.
    void show(const FrameFiles& files);

    /// Leaves receivers of that frame out, before its masks are asked for. They count as seen otherwise than by the truth: a
    /// picture that says nothing of them, though light reaches them, does not show what is there.
    void leaveOut(Pixels pixels) { leftOut_ = std::move(pixels); }

    /// The receivers that the renderer saw. Throws BadInput when away from geometry's edges more than 0.1 % of the pixels
    /// disagree: then camera or geometry differ.
    [[nodiscard]] metrics::Mask seen(Truth truth);

    /// Those that are scored; valid as long as this object.
    const metrics::Mask& scored(Truth truth);

private:
    SceneFrames& frames_;
    const ForeignRow& row_;
    FrameFiles files_;
    std::optional<Image<float>> hits_, depth_;
    Pixels leftOut_;
    std::map<std::pair<Truth, int>, metrics::Mask> masks_;
};

} // namespace shadowbench::foreign
