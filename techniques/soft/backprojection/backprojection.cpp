// Soft shadow mapping by back projection (Guennebaud et al. 2006; Atty et al. 2006; Aszódi and Szirmay-Kalos 2006): the
// texels of one shadow map from the light's centre are the occluders. Scherzer 2.3.4, Fig. 2.22.
//
// 1. A min/max pyramid of the map bounds the region that can hide light from a receiver, and passes over parts of it that
// cannot. The region is limited to `texels` per side, beyond which texels are left out: it "has to be limited to allow
// real-time performance".
// 2. Each texel in front of the receiver is projected back onto the light and clipped to it.
// 3. A gap between a texel's image and its right or upper neighbour's is filled by prolonging the texel's.
// 4. The areas are summed.
//
// Departures: squares of the pyramid whose depths hardly differ are one quad (`flat`), and the sum ends when it covers the
// light; texels beside the receiver's own are compared with the receiver's plane (bias=slope), without which slanted
// surfaces shadow themselves; a light whose sides are not quite at right angles is taken for the rectangle of the same
// sides.
//
// It fails where the papers say so: images that overlap count twice, so that two occluders at different heights darken too
// much, and so do surfaces that fall off from the light; gaps that are really there, between occluders that only seem to
// touch, are filled; and what the map's one layer does not hold does not occlude.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/back_projection.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

class BackProjection final : public Technique {
public:
    explicit BackProjection(const Parameters& p)
        : fillGaps_(p.text("gaps") == "fill"), followPlane_(p.text("bias") == "slope"), widest_(p.integer("texels")),
          flatness_(static_cast<float>(p.real("flat"))), map_(p.integer("map"), biasFrom(p)),
          pyramid_(p.integer("map"), NodeEnds::Shared), resolve_(program(Writes::Visibility)) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        pyramid_.draw(map_.texture(), frame);
        set(resolve_, frame);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        gl::Program counting = program(Writes::Quads);
        set(counting, frame);
        return {{"quads", meanOverReceivers(frame, counting)}};
    }

private:
    enum class Writes { Visibility, Quads };
    [[nodiscard]] gl::Program program(Writes writes) const {
        const gl::Defines defines{{"FILL_GAPS", fillGaps_ ? "1" : "0"},
                                  {"COUNT_QUADS", writes == Writes::Quads ? "1" : "0"}};
        return gl::Program::screen("soft/backprojection/backprojection.frag", defines);
    }

    void set(gl::Program& program, const Frame& frame) const {
        setBackProjection(program, frame, view_, pyramid_, followPlane_);
        program.set("linearDepth", map_.texture()).set("flatness", flatness_).set("widest", widest_);
    }

    bool fillGaps_, followPlane_;
    int widest_;
    float flatness_;
    LightView view_; // of the frame rendered last
    LinearDepthMap map_;
    MinMaxPyramid pyramid_;
    gl::Program resolve_;
};

std::optional<std::string> lightThatIsNoRectangle(const Scene& scene) {
    if (!scene.light.isArea() || scene.light.kind == LightKind::Rectangle) return std::nullopt;
    return fmt::format("clips the texels' images to a rectangular light; the light of {} is a {}", scene.id,
                       name(scene.light.kind));
}

} // namespace

Entry backprojection() {
    std::vector<Parameter> parameters = withDepthMapParameters(
        {{"gaps", "fill", OneOf{{"fill", "leave"}}, "gaps between the images of neighbouring texels",
          "dissertation, Fig. 2.22"},
         {"texels", "48", IntegerRange{1, 128},
          "per side of the search area, at most: of a wider one every second texel is taken, or every fourth, …",
          "dissertation, 2.3.4"},
         flatParameter()});
    return {.id = "backprojection",
            .title = "Soft shadow mapping by back projection",
            .source = {Document::Dissertation, "2.3.4, Fig. 2.22"},
            .answer = Answer::Soft,
            .notApplicable = lightThatIsNoRectangle,
            .parameters = std::move(parameters),
            .figures = {{"quads", "quads that a receiver's pixel projects onto the light, in the mean"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<BackProjection>(p); }};
}

} // namespace shadowbench::techniques
