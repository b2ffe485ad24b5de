// Fake soft shadow on a plane (Zápotocký 5.2 and A.6): the shadow projected from the light's centre is drawn into a texture,
// and each pixel of the receiver takes the mean of 7×7 lookups in it. The penumbra is as wide everywhere, whatever the
// light's size and the caster's height; no other surface gets a shadow. Departures: those of planar-hard; the texture lies
// over the receiver's rectangle in its plane, since the thesis does not say what its texture is spread over; 4×4 lookups
// give the mean of the 7×7 (box.glsl).
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/planar/projected_casters.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowbench::techniques {
namespace {

/// Takes the receiver's rectangle to x, y in [−1, 1]; z is 0.
glm::dmat4 clipFromReceiver(const PlanarReceiver& receiver) {
    const glm::dvec3 normal(receiver.plane);
    const glm::dvec3 off = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = glm::normalize(off - glm::dot(off, normal) * normal);
    const glm::dvec3 v = glm::cross(normal, u);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& corner : receiver.corners) {
        const glm::dvec2 at(glm::dot(u, corner), glm::dot(v, corner));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 scale = 2.0 / (high - low);
    const glm::dvec2 shift = -0.5 * scale * (low + high);
    return glm::transpose(glm::dmat4(glm::dvec4(scale.x * u, shift.x), glm::dvec4(scale.y * v, shift.y), glm::dvec4(0),
                                     glm::dvec4(0, 0, 0, 1)));
}

class PlanarFake final : public Technique {
public:
    explicit PlanarFake(const Parameters& p)
        : shadow_(gl::Format::R8, glm::ivec2(p.integer("map")), gl::Filter::Linear), shadowTarget_{&shadow_},
          resolve_(gl::Program::screen("planar/planar-fake/planar-fake.frag", {{"KERNEL", p.text("kernel")}})) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const auto receiver = finder_.find(frame.snapshot, frame.hardLight);
        if (!receiver) {
            gl::RenderTarget({&visibility}).clearColour(0, glm::vec4(1));
            return;
        }
        const glm::dmat4 clip = clipFromReceiver(*receiver);
        drawShadow(frame, *receiver, clip);

        const glm::dmat4 half = glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(1));
        resolve_.set("positions", frame.gbuffer.position())
            .set("ids", frame.gbuffer.id())
            .set("receiverId", static_cast<int>(receiver->id))
            .set("plane", glm::vec4(receiver->plane))
            .set("margin", planeMargin(*receiver))
            .set("mapFromWorld", glm::mat4(half * clip))
            .set("shadow", shadow_);
        resolve(frame, {&visibility}, resolve_);
    }

private:
    void drawShadow(const Frame& frame, const PlanarReceiver& receiver, const glm::dmat4& clip) {
        const auto pass = frame.pass("projected casters");
        shadowTarget_.clearColour(0, glm::vec4(1));
        shadowTarget_.bind();
        casters_.draw(frame.scene, receiver, frame.hardLight.homogeneous(), clip, 0);
    }

    gl::Texture shadow_;
    gl::RenderTarget shadowTarget_;
    ReceiverFinder finder_;
    ProjectedCasters casters_;
    gl::Program resolve_;
};

} // namespace

Entry planarFake() {
    return {.id = "planar-fake",
            .title = "Projected shadow on a plane, percentage-closer filtered",
            .source = {Document::Zapotocky, "5.2 and A.6"},
            .answer = Answer::Filtered,
            .lacks = {Need::AnyReceiver},
            .notApplicable = noPlanarReceiver,
            .parameters = {{"kernel", "7", OneOf{{"3", "5", "7", "9"}}, "taps per side", "Zápotocký 5.2"},
                           {"map", "1024", IntegerRange{16, 8192}, "texels per side of the texture over the receiver", ""}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PlanarFake>(p); }};
}

} // namespace shadowbench::techniques
