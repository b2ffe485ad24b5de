#include "harness/inspect/inspection.h"

#include "harness/inspect/meshes.h"
#include "harness/inspect/warnings.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowbench::inspect {
namespace {

constexpr int kCoarseSide = 64;

/// The scene's image, no larger than `side`.
glm::ivec2 sizeWithin(glm::ivec2 size, int side) {
    const double scale = std::min(1.0, static_cast<double>(side) / std::max(size.x, size.y));
    return glm::max(glm::ivec2(1), glm::ivec2(glm::round(scale * glm::dvec2(size))));
}

bool isUniform(const FrameReport& frame) { return frame.receivers < 1e-3 || frame.lit == 0 || frame.shadowed == 0; }

} // namespace

Inspection inspect(const Scene& scene) {
    const Snapshot frame = snapshot(scene, scene.timeline.still - 1);
    const View view(frame);
    const View::Seen seen = view.seen(frame.light, scene.size, true);
    Inspection result{.scene = scene.id,
                      .title = scene.title,
                      .profile = scene.profile,
                      .moved = scene.moved,
                      .camera = frame.camera,
                      .light = frame.light,
                      .box = frame.bounds(),
                      .meshes = meshReports(scene),
                      .frame = seen.report,
                      .texels = view.texels(seen),
                      .warnings = {},
                      .picture = view.picture(seen)};
    result.toScene = glm::distance(frame.camera.eye, glm::clamp(frame.camera.eye, result.box.low, result.box.high));
    const FlatAreas flat = flatAreas(scene);
    for (const int axis : {0, 2})
        if (flat.area[axis] > flat.area[result.upAxis]) result.upAxis = axis;
    result.warnings = warningsOf({scene, frame, result.box, view, seen}, result.meshes);
    return result;
}

std::vector<Warning> warningsOf(const Scene& scene) {
    const Snapshot frame = snapshot(scene, scene.timeline.still - 1);
    const View view(frame);
    View::Seen seen = view.seen(frame.light, sizeWithin(scene.size, kCoarseSide), false);
    if (isUniform(seen.report)) seen = view.seen(frame.light, sizeWithin(scene.size, 4 * kCoarseSide), true);
    return warningsOf({scene, frame, frame.bounds(), view, seen}, meshReports(scene));
}

std::string lineOf(const Warning& warning) { return "warning: " + warning.what + "; " + warning.remedy; }

} // namespace shadowbench::inspect
