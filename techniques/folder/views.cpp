#include "techniques/folder/views.h"

#include "base/error.h"
#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/light_views/visible_part.h"
#include "techniques/shared/sampling/sampling.h"

namespace shadowbench::techniques {
namespace {

constexpr int sidesOfCube = 6;

/// Whether the camera sees some of the scene's box through the side: else no pixel is tested against its map.
bool isSeen(const LightView& side, const Frame& frame) {
    const auto frustum = frustumPlanes(side.clipFromWorld);
    std::vector<glm::dvec4> sides(frustum.begin(), frustum.begin() + 4);
    for (glm::dvec4& plane : sides) plane.w += 1e-5 * side.far; // the G-buffer's positions are rounded
    return !visiblePart(frame.snapshot.bounds(), frame.snapshot.camera, frame.aspect(), sides).empty();
}

} // namespace

FolderViews::FolderViews(const TechniqueFolder& folder, const Parameters& values)
    : kind_(viewOf(folder, values)), soft_(folder.entry.answer == Answer::Soft) {
    if (kind_ == FolderView::Cube) count_ = sidesOfCube;
    if (kind_ != FolderView::Cascades) return;
    CascadeRule rule = cascadeRule(folder.cascades, values);
    rule.soft = soft_;
    count_ = rule.slices;
    cascades_.emplace(rule);
}

std::vector<Tile> FolderViews::tiles(int side) const { return squareTiles(side, count_); }

void FolderViews::reset() {
    if (cascades_) cascades_->reset();
}

void FolderViews::fit(const Frame& frame, int tile) {
    if (kind_ == FolderView::Cube) return fitCube(frame);
    if (!cascades_) {
        views_ = {single(frame)};
        return;
    }
    cascades_->fit(frame, tile);
    views_ = cascades_->views();
    casters_ = cascades_->casters();
}

void FolderViews::fitCube(const Frame& frame) {
    light_ = frame.snapshot.light.centre;
    const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
    views_ = cubeViews(light_, corners);
    casters_.clear();
    for (const LightView& side : views_)
        casters_.push_back(isSeen(side, frame) ? castersIn(side, corners) : std::vector<bool>(corners.size() / 8, false));
}

LightView FolderViews::single(const Frame& frame) const {
    const Light& light = soft_ ? frame.snapshot.light : frame.hardLight;
    const Camera& camera = frame.snapshot.camera;
    switch (kind_) {
    case FolderView::Scene:
        return fitToScene(light, frame.snapshot);
    case FolderView::Focused:
        return fitFocused(frame.hardLight, frame.snapshot, camera, frame.aspect());
    case FolderView::Lispsm:
        return fitLispsm(frame.hardLight, frame.snapshot, camera, frame.aspect());
    case FolderView::Sample: {
        const glm::dvec2 at(haltonOf(frame.index, frame.seed, 2), haltonOf(frame.index, frame.seed, 3));
        return fitFromSample(light, light.sample(at), frame.snapshot);
    }
    case FolderView::Cube:
    case FolderView::Cascades:
        break;
    }
    throw InternalError("a technique folder of several views has no single one");
}

std::size_t FolderViews::viewAt(const glm::dvec3& world) const {
    if (cascades_) return cascades_->sliceAt(world);
    return kind_ == FolderView::Cube ? cubeSide(world - light_) : 0;
}

} // namespace shadowbench::techniques
