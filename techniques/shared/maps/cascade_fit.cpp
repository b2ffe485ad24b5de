#include "techniques/shared/maps/cascade_fit.h"

#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/light_views/visible_part.h"

#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// What a box of receivers is widened by on every side, so that one of a single point is a body and that point does not lie
/// on its near plane, to which nearer casters are clamped. Of the scene's map, from −1 to 1.
constexpr double leastHalf = 1e-5;

glm::dvec4 eyeDepthOf(const Camera& camera) {
    const glm::dvec3 forward = camera.basis().forward;
    return glm::dvec4(forward, -glm::dot(forward, camera.eye));
}

} // namespace

CascadeFit::CascadeFit(const CascadeRule& rule) : rule_(rule) {
    if (rule_.visible) receivers_.emplace(rule_.slices);
}

void CascadeFit::fit(const Frame& frame, int texels) {
    if (!receivers_) {
        region_ = viewed(frame);
    } else if (!rule_.late) {
        region_ = seen(frame);
    } else {
        region_ = before_ ? std::move(*before_) : viewed(frame);
        before_ = seen(frame);
    }
    fitSlices(frame, texels);
}

std::vector<glm::vec4> CascadeFit::ends() const {
    const std::vector<double>& splits = region_.splits;
    std::vector<glm::vec4> ends;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i)
        ends.emplace_back(splits[i + 1], splits[i + 1] - rule_.blend * (splits[i + 1] - splits[i]), 0, 0);
    return ends;
}

std::size_t CascadeFit::sliceAt(const glm::dvec3& world) const {
    return sliceOf(region_.splits, glm::dot(region_.eyeDepthFromWorld, glm::dvec4(world, 1)));
}

CascadeFit::Region CascadeFit::viewed(const Frame& frame) const {
    const Camera& camera = frame.snapshot.camera;
    Region region{.camera = camera, .eyeDepthFromWorld = eyeDepthOf(camera)};
    divide(region, rule_.stable ? DepthRange{camera.near, camera.far}
                                : visibleDepths(frame.snapshot.bounds(), camera, frame.aspect()));
    return region;
}

CascadeFit::Region CascadeFit::seen(const Frame& frame) {
    const Camera& camera = frame.snapshot.camera;
    Region region{.camera = camera, .eyeDepthFromWorld = eyeDepthOf(camera), .ofPoints = true};
    const auto depths = receivers_->depths(frame, region.eyeDepthFromWorld);
    divide(region, depths.value_or(DepthRange{camera.near, camera.far}));
    region.clipFromWorld = fitToScene(lightOf(frame), frame.snapshot).clipFromWorld;
    region.boxes = receivers_->boxes(frame, region.eyeDepthFromWorld, region.ranges, region.clipFromWorld);
    return region;
}

void CascadeFit::divide(Region& region, const DepthRange& depths) const {
    region.splits = practicalSplits(depths.near, depths.far, rule_.slices, rule_.lambda);
    region.ranges = sliceRanges(region.splits, rule_.blend);
}

void CascadeFit::fitSlices(const Frame& frame, int texels) {
    const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
    views_.clear();
    casters_.clear();
    for (std::size_t i = 0; i < region_.ranges.size(); ++i) {
        const bool empty = region_.ofPoints && !region_.boxes[i];
        views_.push_back(empty ? fitToScene(lightOf(frame), frame.snapshot) : sliceView(frame, i, texels));
        casters_.push_back(empty ? std::vector<bool>(corners.size() / 8, false) : castersIn(views_[i], corners));
    }
}

const Light& CascadeFit::lightOf(const Frame& frame) const { return rule_.soft ? frame.snapshot.light : frame.hardLight; }

LightView CascadeFit::sliceView(const Frame& frame, std::size_t slice, int texels) const {
    Camera part = region_.camera;
    part.near = region_.ranges[slice].near;
    part.far = region_.ranges[slice].far;
    if (rule_.soft) return partOfScene(frame, slice, part);
    const Light& light = frame.hardLight;
    if (rule_.stable && light.kind == LightKind::Directional)
        return fitStable(light, frame.snapshot, part, frame.aspect(), texels);
    std::vector<glm::dvec4> within;
    if (region_.ofPoints) {
        Bounds box = *region_.boxes[slice];
        box.low -= leastHalf;
        box.high += leastHalf;
        for (const glm::dvec4& plane : frustumPlanes(fitMatrix(box, 0) * region_.clipFromWorld)) within.push_back(plane);
    }
    return (rule_.warped ? fitLispsm : fitFocused)(light, frame.snapshot, part, frame.aspect(), within);
}

/// Depths are those of the scene's map: a caster that was held on a near plane of the slice's own would have a narrower
/// penumbra.
LightView CascadeFit::partOfScene(const Frame& frame, std::size_t slice, const Camera& part) const {
    const Light& light = lightOf(frame);
    const LightView whole = fitToScene(light, frame.snapshot);
    Bounds box;
    if (region_.ofPoints) {
        box = *region_.boxes[slice];
    } else {
        const auto lit = frustumPlanes(whole.clipFromWorld);
        const auto body = visiblePart(frame.snapshot.bounds(), part, frame.aspect(), lit);
        if (body.size() < 3) return whole;
        box = boundsOf(whole.clipFromWorld, body);
    }
    // Half the light as the farthest receiver sees it on the near plane: what hides some of it lies no farther beside.
    const glm::dvec2 half = 0.5 * glm::dvec2(glm::length(light.u), glm::length(light.v)) * (1 / whole.near - 1 / whole.far);
    const glm::dvec2 beside = half / whole.span + leastHalf;
    return partOf(whole, 0.5 + 0.5 * glm::dvec2(box.low) - beside, 0.5 + 0.5 * glm::dvec2(box.high) + beside);
}

} // namespace shadowbench::techniques
