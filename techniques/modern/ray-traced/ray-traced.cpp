// Ray-traced soft shadows as games have them: a few rays a pixel to random points of an area light, in each frame others,
// through a tree over all triangles. 1. the tree, anew whenever a caster has moved  2. the share of a pixel's rays that are
// free. The share is an unbiased estimate: with n rays of a pixel that sees V of the light its variance is V (1 − V) / n,
// and what is left of it is for a denoiser. Departures: points are independent, where engines take blue noise, so that the
// error is the closed form's; the tree is cut at medians and walked in the shader, where engines leave both to the driver.
#include "techniques/contract/entry.h"
#include "techniques/modern/traced_rays.h"

namespace shadowbench::techniques {
namespace {

class RayTraced final : public Technique {
public:
    explicit RayTraced(const Parameters& p) : rays_(p.text("rays")) {}

    void reset() override { rays_.forget(); }

    void render(const Frame& frame, const gl::Texture& visibility) override { rays_.draw(frame, visibility, "resolve"); }

private:
    TracedRays rays_;
};

} // namespace

Entry rayTraced() {
    return {.id = "ray-traced",
            .title = "Ray-traced soft shadows, a few rays a pixel",
            .source = {Document::Other, "Schied et al. 2017, 3; AnKi"},
            .answer = Answer::Soft,
            .computed = TracedRays::computed,
            // llvmpipe ends a shader's loops after 65,535 rounds: 16 rays may take 4,000 nodes each.
            .parameters = {{"rays", "1", IntegerRange{1, 16}, "rays a pixel and frame, each to another point of the light",
                            "Schied et al. 2017: 1"}},
            .variants = {"", "rays=2", "rays=4"},
            .make = [](const Parameters& p) { return std::make_unique<RayTraced>(p); }};
}

} // namespace shadowbench::techniques
