// Percentage-closer filtering over a Poisson disk (Reeves, Salesin, Cook 1987; Scherzer 2.2.1): the share of a disk's shadow
// tests that pass, the disk turned by an angle of each pixel's own, so that too few taps show as noise instead of bands. The
// angle is a hash of pixel and seed: the noise stands still with the camera. Departures: the disk is a round of texels
// around the receiver, where the paper projects the pixel into the map; as for `pcf`, with a bias that follows slopes each
// tap is compared with the depth of the receiver's plane at the tap.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/normal_offset.h"
#include "techniques/shared/maps/single_map.h"
#include "techniques/shared/sampling/sampling.h"

namespace shadowbench::techniques {
namespace {

gl::Defines definesOf(const Parameters& p) {
    gl::Defines defines = normalOffsetDefines(biasFrom(p));
    defines.emplace_back("TAPS", p.text("taps"));
    return defines;
}

class PcfPoisson final : public Technique {
public:
    explicit PcfPoisson(const Parameters& p)
        : taps_(poissonTaps(p.integer("taps"), Region::Disk)), radius_(static_cast<float>(p.real("radius"))),
          turned_(p.text("rotate") == "pixel"), followPlane_(followsPlane(p)), bias_(biasFrom(p)),
          map_(p.integer("map"), bias_, Lookup::Compare),
          resolve_(gl::Program::screen("filtered/pcf-poisson/pcf-poisson.frag", definesOf(p))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        map_.draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_.texture())
            .set("followPlane", followPlane_ ? 1.0F : 0.0F)
            .set("disk", taps_)
            .set("radius", radius_)
            .set("turned", turned_ ? 1 : 0)
            .set("seed", static_cast<int>(frame.seed));
        setNormalOffset(resolve_, frame, bias_, map_.texture().size());
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, glm::dvec2(map_.side()));
    }

private:
    std::vector<glm::vec2> taps_;
    float radius_;
    bool turned_, followPlane_;
    Bias bias_;
    LightView light_;
    DepthMap map_;
    gl::Program resolve_;
};

} // namespace

Entry pcfPoisson() {
    std::vector<Parameter> parameters = withNormalOffset(withDepthMapParameters({
        {"taps", "16", IntegerRange{4, 64}, "taps of the disk", "dissertation 2.2.1"},
        {"radius", "3.5", RealRange{0.5, 32}, "of the disk in texels; 3.5 reaches as far as pcf:kernel=7", ""},
        {"rotate", "pixel", OneOf{{"none", "pixel"}}, "turn the disk by an angle of each pixel's own", ""},
    }));
    return {.id = "pcf-poisson",
            .title = "Percentage-closer filtering over a Poisson disk",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PcfPoisson>(p); }};
}

} // namespace shadowbench::techniques
