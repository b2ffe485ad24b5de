// Midpoint shadow map (Woo 1992) over the uniform light frustum: no bias at all. Course, "Bias" (Second Depth Shadow Maps);
// Zápotocký 4.4.2. The paper's second depth is the next surface; `second=backface` is Zápotocký's pair of front and back
// faces, which is the same on closed meshes that do not meet, and loses the shadow of open ones. Departure: both depths are
// kept and averaged where a receiver looks them up, which gives the same numbers as a third map of the means.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/midpoint_map.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {
namespace {

class Midpoint final : public Technique {
public:
    Midpoint(int side, SecondDepth second)
        : depths_(side, second), resolve_(gl::Program::screen("maps/sm-midpoint/sm-midpoint.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        depths_.draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("firstDepth", depths_.first())
            .set("secondDepth", depths_.second());
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, depths_.first().size());
    }

private:
    LightView light_;
    TwoDepths depths_;
    gl::Program resolve_;
};

} // namespace

Entry smMidpoint() {
    return {.id = "sm-midpoint",
            .title = "Midpoint shadow map",
            .source = {Document::Course, "Bias; Zápotocký 4.4.2"},
            .answer = Answer::Hard,
            .parameters = {mapParameter(),
                           {"second", "surface", OneOf{{"surface", "backface"}},
                            "what the nearest depth is averaged with: the next surface, or front with back faces",
                            "course, Bias; Zápotocký 4.4.2"}},
            .variants = {""},
            .make = [](const Parameters& p) {
                const SecondDepth second = p.text("second") == "surface" ? SecondDepth::Surface : SecondDepth::BackFace;
                return std::make_unique<Midpoint>(p.integer("map"), second);
            }};
}

} // namespace shadowbench::techniques
