// Smoothies (Chan, Durand 2003; course, "Rendering Fake Soft Shadows with Smoothies"; dissertation 2.3.2):
// 1. a shadow map from the light's centre  2. the casters' silhouette edges  3. smoothies: a rectangle of
// fixed width in the light's image on the outside of each edge, and a quad at each convex corner, drawn into a buffer of
// depth and α' = α / (1 − b/r), with α from 0 at the edge to 1 at the rim, b the smoothie's depth and r the map's; where
// smoothies overlap the least α' is kept  4. a pixel is dark behind the map, has α' behind a smoothie, and is lit elsewhere.
// Only the outer penumbra is drawn: the umbra is the hard shadow, and does not shrink as the light grows.
// Departures: the paper leaves the width to the user; here it is the radius of the light over the depth of the caster's
// middle, with which the penumbra's outer rim is the light's. Depth and α' take one pass, for the nearest depth is a least
// value, too. A smoothie behind what the map sees is left out: there 1 − b/r is negative. A receiver well before what its
// texel saw is lit, for α' is not its own: the rims of casters read the texel beside theirs, and would be dark. The map has
// no bias, receivers have (outline_geometry.h).
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/soft/outline_geometry.h"

#include <cmath>
#include <memory>

namespace shadowbench::techniques {
namespace {

/// Appends smoothies and counts them.
class Smoothies {
public:
    explicit Smoothies(double radius) : radius_(radius) {}

    void attach(const AttachTo& caster, std::vector<AttachedVertex>& vertices) {
        const double width = radius_ / caster.depth;
        for (const OutlineSegment& segment : caster.outline.segments) {
            const AttachedVertex a = inner(segment.from), b = inner(segment.to);
            const AttachedVertex c = outer(segment.to, width * segment.outward);
            vertices.insert(vertices.end(), {a, b, c, a, c, outer(segment.from, width * segment.outward)});
            ++edges;
        }
        for (const OutlineCorner& corner : caster.outline.corners()) {
            const AttachedVertex at = inner(corner.at);
            const AttachedVertex tip = outer(corner.at, width * turned(corner.outward, 0.5 * corner.turn));
            vertices.insert(vertices.end(), {at, outer(corner.at, width * corner.outward), tip, at, tip,
                                             outer(corner.at, width * turned(corner.outward, corner.turn))});
            ++corners;
        }
    }

    std::size_t edges = 0, corners = 0;

private:
    static AttachedVertex inner(const OutlinePoint& point) { return {glm::vec3(point.object), glm::vec3(0), 0}; }

    /// Moved by `offset` in the light's image, at its own depth.
    static AttachedVertex outer(const OutlinePoint& point, const glm::dvec2& offset) {
        return {glm::vec3(point.object), glm::vec3(point.seen.z * glm::dvec3(offset, 0)), 1};
    }

    static glm::dvec2 turned(const glm::dvec2& v, double angle) {
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * v.x - s * v.y, s * v.x + c * v.y};
    }

    double radius_;
};

class Smoothie final : public Technique {
public:
    explicit Smoothie(const Parameters& p)
        : bias_(biasFrom(p)), map_(p.integer("map"), Bias{}),
          buffer_(gl::Format::RG32F, glm::ivec2(map_.side())), target_{&buffer_},
          draw_("soft/outline_geometry.vert", "soft/smoothie/buffer.frag"),
          resolve_(gl::Program::screen("soft/smoothie/smoothie.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        view_ = fitToScene(light, frame.snapshot);
        map_.draw(view_, frame);
        smoothies_ = Smoothies(lightRadius(light));
        geometry_.build(frame, view_, [&](const AttachTo& caster, auto& vertices) { smoothies_.attach(caster, vertices); });
        drawBuffer(frame);
        bindOutlineReceiver(resolve_, frame, view_, map_, bias_);
        resolve_.set("smoothies", buffer_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"smoothie_edges", static_cast<double>(smoothies_.edges)},
                {"smoothie_corners", static_cast<double>(smoothies_.corners)}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    void drawBuffer(const Frame& frame) {
        const auto pass = frame.pass("smoothies");
        target_.clearColour(0, glm::vec4(gl::nothingInTheWay, 1, 0, 0));
        target_.bind();
        geometry_.draw(draw_, map_);
    }

    Bias bias_;
    LightView view_;
    LinearisedMap map_;
    Smoothies smoothies_{0};
    OutlineGeometry geometry_;
    gl::Texture buffer_; // depth of the nearest smoothie, least α'
    gl::RenderTarget target_;
    gl::Program draw_, resolve_;
};

} // namespace

Entry smoothie() {
    return {.id = "smoothie",
            .title = "Smoothies",
            .source = {Document::Course, "Rendering Fake Soft Shadows with Smoothies; dissertation 2.3.2"},
            .answer = Answer::Soft,
            .notApplicable = notRound,
            .parameters = receiverBiasParameters(),
            .figures = {{"smoothie_edges", "rectangles that are drawn along silhouette edges"},
                        {"smoothie_corners", "quads that are drawn at convex corners of silhouettes"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Smoothie>(p); }};
}

} // namespace shadowbench::techniques
