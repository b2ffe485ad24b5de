// Variance shadow maps (Donnelly and Lauritzen 2006; Scherzer 2.2.1): each texel holds the mean of depth and of its square,
// averaged over a box and mipmapped; the visible share is bounded by Chebyshev's inequality. Exact for one occluder and one
// receiver that are parallel to the map. Where kernels hold two occluders the bound is not tight and light leaks through the
// nearer one's penumbra: the technique's known failure. Departures: 32-bit floats, which the paper's 16-bit hardware lacked;
// depth is linear, 0 at the nearest and 1 at the farthest point of the scene; moments are
// taken of the depths where the box is begun, and no texture of them unfiltered is written; the box is separable and wide
// ones are taken over means of several texels, so that its cost does not grow with it; footprints of pixels are read
// anisotropically; a box's rim of texels around the scene stays free; the texel's own slope is not added to the second
// moment, since a kernel's mean over a plane is the plane's depth. `bleeding` (Lauritzen 2007) is off: it hides leaks by
// darkening every penumbra.
#include "techniques/filtered/vsm/vsm.h"

#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/prefiltered_map.h"

namespace shadowbench::techniques {

Parameter leastVarianceParameter() {
    return {"variance", "1e-06", RealRange{0, 1}, "least variance of depths in [0, 1]: above what rounding leaves of none",
            ""};
}

namespace {

class Vsm final : public Technique {
public:
    explicit Vsm(const Parameters& p)
        : map_(p, {"filtered/vsm/moments.comp", {}, gl::Format::RG32F, 1}),
          resolve_(gl::Program::screen("filtered/vsm/vsm.frag")) {
        resolve_.set("leastVariance", static_cast<float>(p.real("variance")))
            .set("bleeding", static_cast<float>(p.real("bleeding")));
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        map_.draw(frame);
        map_.bindTo(resolve_, frame);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return map_.pointAt(world); }

private:
    PrefilteredMap map_;
    gl::Program resolve_;
};

} // namespace

Entry vsm() {
    std::vector<Parameter> parameters = prefilteredMapParameters();
    parameters.push_back(leastVarianceParameter());
    parameters.push_back({"bleeding", "0", RealRange{0, 0.99}, "visibility taken for a leak, and removed", ""});
    return {.id = "vsm",
            .title = "Variance shadow map",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {"", "kernel=3"},
            .make = [](const Parameters& p) { return std::make_unique<Vsm>(p); }};
}

} // namespace shadowbench::techniques
