// Ray-traced soft shadows as games have them: a few rays a pixel to random points of an area light, in each frame others,
// through a tree over all triangles. 1. the tree, anew whenever a caster has moved  2. the share of a pixel's rays that are
// free. The share is an unbiased estimate: with n rays of a pixel that sees V of the light its variance is V (1 − V) / n,
// and what is left of it is for a denoiser. Departures: points are independent, where engines take blue noise, so that the
// error is the closed form's; the tree is cut at medians and walked in the shader, where engines leave both to the driver.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/modern/triangle_tree.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

class RayTraced final : public Technique {
public:
    explicit RayTraced(const Parameters& p)
        : resolve_(gl::Program::screen("modern/ray-traced/ray-traced.frag", {{"RAYS", p.text("rays")}})) {}

    void reset() override { built_ = false; }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!built_ || frame.scene.moving()) build(frame);
        nodes_.bindStorage(0);
        corners_.bindStorage(1);
        const Light& light = frame.snapshot.light;
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("lightCentre", glm::vec3(light.centre))
            .set("lightU", glm::vec3(light.u))
            .set("lightV", glm::vec3(light.v))
            .set("disk", light.kind == LightKind::Disk ? 1 : 0)
            .set("lift", lift_)
            .set("frame", frame.index)
            .set("seed", static_cast<int>(frame.seed));
        resolve(frame, {&visibility}, resolve_);
    }

private:
    void build(const Frame& frame) {
        const auto pass = frame.pass("triangle tree");
        const TriangleTree tree = treeOver(frame.snapshot);
        nodes_.upload(tree.nodes.data(), tree.nodes.size() * sizeof(TreeNode));
        corners_.upload(tree.corners.data(), tree.corners.size() * sizeof(glm::vec4));
        const Bounds bounds = frame.snapshot.bounds();
        lift_ =
            static_cast<float>(1e-5 * glm::distance(bounds.low, bounds.high)); // far above the rounding of 32-bit positions
        built_ = true;
    }

    gl::Program resolve_;
    gl::Buffer nodes_, corners_;
    float lift_ = 0;
    bool built_ = false;
};

} // namespace

Entry rayTraced() {
    return {.id = "ray-traced",
            .title = "Ray-traced soft shadows, a few rays a pixel",
            .source = {Document::Other, "Schied et al. 2017, 3; AnKi"},
            .answer = Answer::Soft,
            .computed = "the tree over all triangles: once, and again in each frame in which a caster moves",
            // llvmpipe ends a shader's loops after 65,535 rounds: 16 rays may take 4,000 nodes each.
            .parameters = {{"rays", "1", IntegerRange{1, 16}, "rays a pixel and frame, each to another point of the light",
                            "Schied et al. 2017: 1"}},
            .variants = {"", "rays=2", "rays=4"},
            .make = [](const Parameters& p) { return std::make_unique<RayTraced>(p); }};
}

} // namespace shadowbench::techniques
