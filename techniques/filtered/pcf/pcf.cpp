// Percentage-closer filtering (Reeves, Salesin, Cook 1987): the share of k×k shadow tests around the receiver that pass.
// Scherzer 2.2.1, Zápotocký 3.2; `kernel=2` is the hardware's bilinear 2×2 (course, "Shadow Silhouette Maps"). With
// `depth=midpoint` the map holds the mean of first and second surface (Woo; Zápotocký 4.4.2), which is drawn without any
// bias. Departure: with bias=slope or normal-offset each tap is compared with the depth of the receiver's plane at the tap
// (course, "Bias": the offset follows the surface slope, here over the whole kernel), else a k×k kernel darkens every
// slanted surface. As the sources admit, the penumbra is k texels wide wherever the occluder is.
#include "techniques/filtered/pcf/pcf.h"

#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/normal_offset.h"
#include "techniques/shared/maps/single_map.h"
#include "techniques/shared/maps/stored_depth.h"

namespace shadowbench::techniques {
namespace {

gl::Defines definesOf(const Parameters& p) {
    gl::Defines defines = normalOffsetDefines(biasFrom(p));
    defines.emplace_back("KERNEL", p.text("kernel") == "2" ? "1" : p.text("kernel")); // one tap of the hardware's 2×2
    return defines;
}

class Pcf final : public Technique {
public:
    explicit Pcf(const Parameters& p)
        : bilinear_(p.integer("kernel") == 2), followPlane_(followsPlane(p)), bias_(biasFrom(p)),
          map_(storedDepthMap(p, bilinear_ ? Lookup::CompareBilinear : Lookup::Compare)),
          resolve_(gl::Program::screen("filtered/pcf/pcf.frag", definesOf(p))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        map_->draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_->texture());
        setNormalOffset(resolve_, frame, bias_, map_->texture().size());
        if (!bilinear_) // its one tap lies in the receiver's own texel
            resolve_.set("normals", frame.gbuffer.normal()).set("followPlane", followPlane_ ? 1.0F : 0.0F);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, map_->texture().size());
    }

private:
    bool bilinear_, followPlane_;
    Bias bias_;
    LightView light_;
    std::unique_ptr<ShadowMap> map_;
    gl::Program resolve_;
};

} // namespace

std::vector<Parameter> pcfParameters() {
    return withNormalOffset(withDepthMapParameters({
        {"kernel", "3", OneOf{{"2", "3", "5", "7"}}, "taps per side; 2 is bilinear 2×2", "Zápotocký 3.2"},
        storedDepthParameter(),
    }));
}

std::unique_ptr<Technique> makePcf(const Parameters& parameters) { return std::make_unique<Pcf>(parameters); }

Entry pcf() {
    return {.id = "pcf",
            .title = "Percentage-closer filtering",
            .source = {Document::Zapotocky, "3.2"},
            .answer = Answer::Filtered,
            .parameters = pcfParameters(),
            .variants = {"", "kernel=7"},
            .make = makePcf};
}

} // namespace shadowbench::techniques
