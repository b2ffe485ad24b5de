// Penumbra maps (Wyman, Hansen 2003; dissertation 2.3.2, eq. 2.2 and Fig. 2.17; course, "Construct Smoothies"):
// 1. a shadow map from the centre of a round light  2. the casters' silhouette edges  3. a cone from each
// silhouette vertex, as wide at each depth as the outer penumbra, and a sheet along each silhouette edge, tangent to the
// cones of its ends, are drawn from the light into the penumbra map with intensity I = (Z_F − Z_v) / (Z_P − Z_v) of vertex,
// fragment and map; where they overlap the least is kept  4. a pixel is dark behind the shadow map, and has the intensity of
// its texel elsewhere. Only the outer penumbra is drawn: the umbra is the hard shadow, and does not shrink as the light
// grows. By the equation the intensity is linear in depth, hence not across the penumbra.
// Departures: cones are fans of 32 triangles. The map has no bias, receivers have (outline_geometry.h). A receiver well
// before what its texel saw is lit: without that the rims of casters, which read the texel beside theirs, would be dark. An
// edge that runs so steeply towards the light that the cone of one end holds that of the other has no sheet.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/soft/outline_geometry.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace shadowbench::techniques {
namespace {

/// Appends cones and sheets down to the depth of the farthest thing, and counts them.
class ConesAndSheets {
public:
    explicit ConesAndSheets(double radius) : radius_(radius) {}

    void attach(const AttachTo& caster, std::vector<AttachedVertex>& vertices) {
        far_ = caster.far;
        for (const OutlinePoint& apex : caster.outline.vertices) appendCone(apex, vertices);
        for (const OutlineSegment& segment : caster.outline.segments) appendSheet(segment, vertices);
    }

    std::size_t cones = 0, sheets = 0;

private:
    /// The cone's radius where it ends.
    [[nodiscard]] double reach(const OutlinePoint& apex) const {
        return std::max(0.0, radius_ * (far_ - apex.seen.z) / apex.seen.z);
    }

    static AttachedVertex inner(const OutlinePoint& apex) {
        return {glm::vec3(apex.object), glm::vec3(0), static_cast<float>(apex.seen.z)};
    }

    /// On the rim of the cone, in a direction of the light's image.
    [[nodiscard]] AttachedVertex outer(const OutlinePoint& apex, const glm::dvec2& direction) const {
        const glm::dvec3 end(far_ * apex.image() + reach(apex) * direction, far_);
        return {glm::vec3(apex.object), glm::vec3(end - apex.seen), static_cast<float>(apex.seen.z)};
    }

    void appendCone(const OutlinePoint& apex, std::vector<AttachedVertex>& vertices) {
        constexpr int sides = 32; // a chord of the rim lies half a per cent of the radius within it
        const auto rim = [&](int i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            return outer(apex, {std::cos(angle), std::sin(angle)});
        };
        for (int i = 0; i < sides; ++i) vertices.insert(vertices.end(), {inner(apex), rim(i), rim(i + 1)});
        ++cones;
    }

    /// The outer tangent of the two rims is m · x = constant with m · (b − a) = reach(a) − reach(b).
    void appendSheet(const OutlineSegment& segment, std::vector<AttachedVertex>& vertices) {
        const glm::dvec2 between = far_ * (segment.to.image() - segment.from.image());
        const double length = glm::length(between);
        const double along = (reach(segment.from) - reach(segment.to)) / length;
        if (std::abs(along) >= 1) return;
        const glm::dvec2 tangent = along / length * between + std::sqrt(1 - along * along) * segment.outward;
        const AttachedVertex a = inner(segment.from), b = inner(segment.to), c = outer(segment.to, tangent);
        vertices.insert(vertices.end(), {a, b, c, a, c, outer(segment.from, tangent)});
        ++sheets;
    }

    double radius_;
    double far_ = 0;
};

class PenumbraMap final : public Technique {
public:
    explicit PenumbraMap(const Parameters& p)
        : bias_(biasFrom(p)), map_(p.integer("map"), Bias{}),
          penumbrae_(gl::Format::R32F, glm::ivec2(map_.side())), target_{&penumbrae_},
          draw_("soft/outline_geometry.vert", "soft/penumbra-map/intensity.frag"),
          resolve_(gl::Program::screen("soft/penumbra-map/penumbra-map.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        view_ = fitToScene(light, frame.snapshot);
        map_.draw(view_, frame);
        attached_ = ConesAndSheets(lightRadius(light));
        geometry_.build(frame, view_, [&](const AttachTo& caster, auto& vertices) { attached_.attach(caster, vertices); });
        drawPenumbrae(frame);
        bindOutlineReceiver(resolve_, frame, view_, map_, bias_);
        resolve_.set("penumbrae", penumbrae_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"penumbra_cones", static_cast<double>(attached_.cones)},
                {"penumbra_sheets", static_cast<double>(attached_.sheets)}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    void drawPenumbrae(const Frame& frame) {
        const auto pass = frame.pass("penumbra map");
        target_.clearColour(0, glm::vec4(1));
        target_.bind();
        geometry_.draw(draw_, map_);
    }

    Bias bias_;
    LightView view_;
    LinearisedMap map_;
    ConesAndSheets attached_{0};
    OutlineGeometry geometry_;
    gl::Texture penumbrae_; // least intensity on what the shadow map sees
    gl::RenderTarget target_;
    gl::Program draw_, resolve_;
};

} // namespace

Entry penumbraMap() {
    return {.id = "penumbra-map",
            .title = "Penumbra map",
            .source = {Document::Dissertation, "2.3.2, eq. 2.2"},
            .answer = Answer::Soft,
            .notApplicable = notRound,
            .parameters = receiverBiasParameters(),
            .figures = {{"penumbra_cones", "cones that are drawn at silhouette vertices"},
                        {"penumbra_sheets", "sheets that are drawn along silhouette edges"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PenumbraMap>(p); }};
}

} // namespace shadowbench::techniques
