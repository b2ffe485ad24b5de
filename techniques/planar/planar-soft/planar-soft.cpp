// N projected shadows blended, one from each point of an area light (Zápotocký 2.2 and B.3; 5.2, 64 and 100 samples).
// Converges to the visible fraction of the light on the receiver's plane as N grows, at a cost that grows with N; no other
// surface gets a shadow. Departures: those of planar-hard, and the light's points are a Hammersley set, as in sampled-maps.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/planar/projected_casters.h"
#include "techniques/shared/sampling/light_points.h"

#include <optional>
#include <utility>

namespace shadowbench::techniques {
namespace {

// Stencil bits: the pixel sees the receiver; the present sample's shadow has been counted there.
constexpr unsigned seesReceiver = 0x01, counted = 0x02;

class PlanarSoft final : public Technique {
public:
    explicit PlanarSoft(const Parameters& p)
        : count_(p.integer("n")), mean_(gl::Program::screen("shared/sampling/mean.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!lit_ || lit_->size() != frame.size) lit_.emplace(gl::Format::R32F, frame.size);
        const gl::RenderTarget target({&*lit_, &frame.gbuffer.depthStencil()});
        target.clearColour(0, glm::vec4(static_cast<float>(count_)));
        if (const auto receiver = finder_.find(frame.snapshot, frame.hardLight)) {
            casters_.markReceiver(frame, *receiver, target);
            for (const glm::dvec3& light : lightPoints(frame.snapshot.light, "hammersley", count_, frame.seed))
                takeShadow(frame, *receiver, light, target);
        }
        mean_.set("sum", *lit_).set("count", static_cast<float>(count_));
        resolve(frame, {&visibility}, mean_);
    }

private:
    /// Takes one from the count of light points at each receiver pixel that the shadow from `light` covers, however often.
    void takeShadow(const Frame& frame, const PlanarReceiver& receiver, const glm::dvec3& light,
                    const gl::RenderTarget& target) {
        const auto pass = frame.pass("projected casters");
        glEnable(GL_STENCIL_TEST);
        glStencilMask(counted);
        target.bind();
        constexpr GLint none = 0;
        glClearBufferiv(GL_STENCIL, 0, &none);
        glStencilFunc(GL_EQUAL, seesReceiver, seesReceiver | counted);
        glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        casters_.draw(frame.scene, receiver, glm::dvec4(light, 1), frame.clipFromWorld, -1);
        glDisable(GL_BLEND);
        glStencilMask(0xFF);
        glDisable(GL_STENCIL_TEST);
    }

    int count_;
    ReceiverFinder finder_;
    ProjectedCasters casters_;
    gl::Program mean_;
    std::optional<gl::Texture> lit_;
};

} // namespace

Entry planarSoft() {
    return {.id = "planar-soft",
            .title = "Projected shadows on a plane, blended",
            .source = {Document::Zapotocky, "2.2 and B.3"},
            .answer = Answer::Soft,
            .lacks = {Need::AnyReceiver},
            .notApplicable = noPlanarReceiver,
            .parameters = {lightCountParameter("light samples, one projection each")},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PlanarSoft>(p); }};
}

} // namespace shadowbench::techniques
