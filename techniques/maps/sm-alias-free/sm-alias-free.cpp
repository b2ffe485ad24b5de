// Alias-free shadow maps (Aila, Laine 2004; Johnson, Mark, Burns 2004): the irregular z-buffer. Pixels are projected into
// the light's view and kept in lists, one a grid cell; every triangle is then tested exactly against the pixels of all cells
// that it touches. Scherzer 2.2.2, "Irregular Sampling"; the lists and the order of work are those of Sintorn, Eisemann,
// Assarsson 2008 (2.3.5), in compute shaders. Departures: those of techniques/shared/maps/pixel_lists.h; the test is made in
// world space relative to the pixel's point.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/pixel_lists.h"
#include "techniques/shared/maps/single_map.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

constexpr int lights = 1;
constexpr int roundsOfLarge = 2; // a round of the loop of shadeLarge() (cast.comp), and a share of other loops

class AliasFree final : public Technique {
public:
    explicit AliasFree(const Parameters& p)
        : slack_(p.real("slack")), lists_("maps/sm-alias-free/cast.comp", {}, p.integer("grid"), 1, lights, roundsOfLarge),
          resolve_(gl::Program::screen("shared/maps/unhidden.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Bounds bounds = frame.snapshot.bounds();
        lists_.gather(frame, focusedView(frame), {frame.hardLight.homogeneous()});
        lists_.cast(frame, [&](gl::Program& program) {
            program.set("light", glm::vec4(frame.hardLight.homogeneous()))
                .set("slack", static_cast<float>(slack_ * glm::distance(bounds.low, bounds.high)));
        });
        resolve_.set("width", frame.size.x);
        resolve(frame, {&visibility}, resolve_);
    }

private:
    double slack_;
    PixelLists lists_;
    gl::Program resolve_;
};

} // namespace

Entry smAliasFree() {
    return {.id = "sm-alias-free",
            .title = "Alias-free shadow map (irregular z-buffer)",
            .source = {Document::Dissertation, "2.2.2, Irregular Sampling; 2.3.5"},
            .answer = Answer::Hard,
            .parameters = {{"grid", "256", IntegerRange{1, 2048}, "cells per side of the grid over the light's view", ""},
                           {"slack", "1e-5", RealRange{0, 1},
                            "of the scene's diagonal: a receiver closer than this to a triangle's plane lies on it", ""}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<AliasFree>(p); }};
}

} // namespace shadowbench::techniques
