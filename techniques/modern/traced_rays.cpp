#include "techniques/modern/traced_rays.h"

#include "techniques/contract/resolve.h"
#include "techniques/modern/triangle_tree.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {

TracedRays::TracedRays(const std::string& raysOfAPixel)
    : program_(gl::Program::screen("modern/traced_rays.frag", {{"RAYS", raysOfAPixel}})) {}

void TracedRays::draw(const Frame& frame, const gl::Texture& share, const char* name) {
    if (!built_ || frame.scene.moving()) build(frame);
    const Light& light = frame.snapshot.light;
    program_.set("nodes", nodeTexels_)
        .set("corners", cornerTexels_)
        .set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("lightCentre", glm::vec3(light.centre))
        .set("lightU", glm::vec3(light.u))
        .set("lightV", glm::vec3(light.v))
        .set("disk", light.kind == LightKind::Disk ? 1 : 0)
        .set("lift", lift_)
        .set("frame", frame.index)
        .set("seed", static_cast<int>(frame.seed));
    resolve(frame, {&share}, program_, name);
}

void TracedRays::build(const Frame& frame) {
    const auto pass = frame.pass("triangle tree");
    const TriangleTree tree = treeOver(frame.snapshot);
    nodes_.upload(tree.nodes.data(), tree.nodes.size() * sizeof(TreeNode));
    corners_.upload(tree.corners.data(), tree.corners.size() * sizeof(glm::vec4));
    const Bounds bounds = frame.snapshot.bounds();
    lift_ = static_cast<float>(1e-5 * glm::distance(bounds.low, bounds.high)); // far above the rounding of 32-bit positions
    built_ = true;
}

} // namespace shadowbench::techniques
