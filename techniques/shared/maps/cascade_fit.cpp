#include "techniques/shared/maps/cascade_fit.h"

#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/light_views/visible_part.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

/// What a box of receivers is widened by on every side, so that one of a single point is a body and that point does not lie
/// on its near plane, to which nearer casters are clamped. Of the scene's map, from −1 to 1.
constexpr double leastHalf = 1e-5;

} // namespace

CascadeFit::CascadeFit(const CascadeRule& rule) : rule_(rule) {
    if (rule_.visible) receivers_.emplace(rule_.slices);
}

void CascadeFit::fit(const Frame& frame, int texels) {
    const Camera& camera = frame.snapshot.camera;
    const glm::dvec3 forward = camera.basis().forward;
    eyeDepthFromWorld_ = glm::dvec4(forward, -glm::dot(forward, camera.eye));
    const DepthRange depths = splitDepths(frame);
    splits_ = practicalSplits(depths.near, depths.far, rule_.slices, rule_.lambda);
    fitSlices(frame, sliceRanges(splits_, rule_.blend), texels);
}

std::vector<glm::vec4> CascadeFit::ends() const {
    std::vector<glm::vec4> ends;
    for (std::size_t i = 0; i + 1 < splits_.size(); ++i)
        ends.emplace_back(splits_[i + 1], splits_[i + 1] - rule_.blend * (splits_[i + 1] - splits_[i]), 0, 0);
    return ends;
}

std::size_t CascadeFit::sliceAt(const glm::dvec3& world) const {
    return sliceOf(splits_, glm::dot(eyeDepthFromWorld_, glm::dvec4(world, 1)));
}

DepthRange CascadeFit::splitDepths(const Frame& frame) {
    const Camera& camera = frame.snapshot.camera;
    const DepthRange planes{camera.near, camera.far};
    if (receivers_) return receivers_->depths(frame, eyeDepthFromWorld_).value_or(planes);
    return rule_.stable ? planes : visibleDepths(frame.snapshot.bounds(), camera, frame.aspect());
}

void CascadeFit::fitSlices(const Frame& frame, const std::vector<DepthRange>& ranges, int texels) {
    const LightView whole = fitToScene(frame.hardLight, frame.snapshot);
    std::vector<std::optional<Bounds>> boxes(ranges.size());
    if (receivers_) boxes = receivers_->boxes(frame, eyeDepthFromWorld_, ranges, whole.clipFromWorld);
    const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
    views_.clear();
    casters_.clear();
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const bool empty = receivers_ && !boxes[i];
        views_.push_back(empty ? whole : sliceView(frame, ranges[i], whole, boxes[i], texels));
        casters_.push_back(empty ? std::vector<bool>(corners.size() / 8, false) : castersIn(views_[i], corners));
    }
}

/// `receivers`: their box in the clip space of `whole`.
LightView CascadeFit::sliceView(const Frame& frame, const DepthRange& range, const LightView& whole,
                                const std::optional<Bounds>& receivers, int texels) const {
    Camera slice = frame.snapshot.camera;
    slice.near = range.near;
    slice.far = range.far;
    const Light& light = frame.hardLight;
    if (rule_.stable && light.kind == LightKind::Directional)
        return fitStable(light, frame.snapshot, slice, frame.aspect(), texels);
    std::vector<glm::dvec4> within;
    if (receivers) {
        Bounds box = *receivers;
        box.low -= leastHalf;
        box.high += leastHalf;
        for (const glm::dvec4& plane : frustumPlanes(fitMatrix(box, 0) * whole.clipFromWorld)) within.push_back(plane);
    }
    return (rule_.warped ? fitLispsm : fitFocused)(light, frame.snapshot, slice, frame.aspect(), within);
}

} // namespace shadowbench::techniques
