// Percentage-closer filtering (Reeves, Salesin, Cook 1987): the share of k×k shadow tests around the receiver that pass.
// Scherzer 2.2.1, Zápotocký 3.2; `kernel=2` is the hardware's bilinear 2×2 (course, "Shadow Silhouette Maps"). With
// `depth=midpoint` the map holds the mean of first and second surface (Woo; Zápotocký 4.4.2), which is drawn without any
// bias. Departure: with bias=slope each tap is compared with the depth of the receiver's plane at the tap (course, "Bias":
// the offset follows the surface slope, here over the whole kernel), else a k×k kernel darkens every slanted surface. As the
// sources admit, the penumbra is k texels wide wherever the occluder is.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/midpoint_map.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {
namespace {

class Pcf final : public Technique {
public:
    explicit Pcf(const Parameters& p)
        : bilinear_(p.integer("kernel") == 2), slope_(p.text("bias") == "slope"), side_(p.integer("map")),
          resolve_(gl::Program::screen("filtered/pcf/pcf.frag", {{"KERNEL", bilinear_ ? "1" : p.text("kernel")}})) {
        const Lookup lookup = bilinear_ ? Lookup::CompareBilinear : Lookup::Compare;
        if (p.text("depth") == "midpoint")
            midpoint_ = std::make_unique<MidpointMap>(side_, lookup);
        else
            map_ = std::make_unique<DepthMap>(side_, biasFrom(p), lookup);
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        if (map_)
            map_->draw(light_, frame);
        else
            midpoint_->draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_ ? map_->texture() : midpoint_->texture());
        if (!bilinear_) // its one tap lies in the receiver's own texel
            resolve_.set("normals", frame.gbuffer.normal()).set("followPlane", slope_ ? 1.0F : 0.0F);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, glm::dvec2(side_));
    }

private:
    bool bilinear_, slope_;
    int side_;
    LightView light_;
    std::unique_ptr<DepthMap> map_;
    std::unique_ptr<MidpointMap> midpoint_;
    gl::Program resolve_;
};

} // namespace

Entry pcf() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"kernel", "3", OneOf{{"2", "3", "5", "7"}}, "taps per side; 2 is bilinear 2×2", "Zápotocký 3.2"},
        {"depth", "basic", OneOf{{"basic", "midpoint"}}, "nearest depth, or the mean of first and second surface",
         "Zápotocký 4.4.2"},
    });
    return {.id = "pcf",
            .title = "Percentage-closer filtering",
            .source = {Document::Zapotocky, "3.2"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {"", "kernel=7"},
            .make = [](const Parameters& p) { return std::make_unique<Pcf>(p); }};
}

} // namespace shadowbench::techniques
