// Percentage-closer soft shadows (Fernando 2005), after Zápotocký 3.5 and Scherzer 2.3.3:
// 1. blocker search  2. penumbra width from similar triangles (eq. 3.3)  3. PCF over that width.
// Departures: the search window is the light's own projection on the map's near plane, where the thesis scales an empirical
// offset; a rectangular light has its own width along each side (the thesis's 4.4.1 interpolates a ratio by angle); with
// bias=slope every tap is compared with the receiver's plane, without which wide kernels shadow every slanted surface. The
// map is drawn as depth alone and made linear where it is read.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/pcss_program.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {
namespace {

class Pcss final : public Technique {
public:
    explicit Pcss(const Parameters& p)
        : taps_(PcssTaps::parse(p.text("taps"))), followPlane_(p.text("bias") == "slope"),
          map_(p.integer("map"), biasFrom(p)), resolve_(gl::Program::screen("soft/pcss/pcss.frag", taps_.defines())) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        view_ = fitToScene(light, frame.snapshot);
        map_.draw(view_, frame);
        setPcss(resolve_, taps_, light, view_, map_, followPlane_);
        resolve_.set("positions", frame.gbuffer.position()).set("normals", frame.gbuffer.normal());
        resolve(frame, {&visibility}, resolve_);
    }

private:
    PcssTaps taps_;
    bool followPlane_;
    LightView view_;
    LinearisedMap map_;
    gl::Program resolve_;
};

} // namespace

Entry pcss() {
    std::vector<Parameter> parameters =
        withDepthMapParameters({{"taps", "16+16", OneOf{{"16+16", "32+32", "25+49"}}, "blocker search + filter",
                                 "dissertation 4.2; Zápotocký 5.2"}});
    return {.id = "pcss",
            .title = "Percentage-closer soft shadows",
            .source = {Document::Zapotocky, "3.5"},
            .answer = Answer::Soft,
            .parameters = std::move(parameters),
            .variants = {"", "taps=32+32"},
            .make = [](const Parameters& p) { return std::make_unique<Pcss>(p); }};
}

} // namespace shadowbench::techniques
