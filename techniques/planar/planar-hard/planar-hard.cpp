// Projected shadow (Blinn 1988; Zápotocký 2.2): casters are flattened onto the receiver's plane by eq. 2.3 and drawn there
// in the shadow's colour, within a stencil of the receiver. Exact on that plane; no other surface gets a shadow, casters
// themselves neither. Departures: the stencil marks the receiver's visible pixels, which makes the thesis's polygon offset
// (Code A.4) needless; what is not between plane and light is clipped, where the matrix would throw it back; the receiver is
// chosen from the scene (planar_receiver.h).
#include "techniques/contract/entry.h"
#include "techniques/gl/api.h"
#include "techniques/planar/projected_casters.h"

namespace shadowbench::techniques {
namespace {

class PlanarHard final : public Technique {
public:
    void render(const Frame& frame, const gl::Texture& visibility) override {
        const gl::RenderTarget target({&visibility, &frame.gbuffer.depthStencil()});
        target.clearColour(0, glm::vec4(1));
        const auto receiver = finder_.find(frame.snapshot, frame.hardLight);
        if (!receiver) return;
        casters_.markReceiver(frame, *receiver, target);

        const auto pass = frame.pass("projected casters");
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_EQUAL, 1, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        target.bind();
        casters_.draw(frame.scene, *receiver, frame.hardLight.homogeneous(), frame.clipFromWorld, 0);
        glDisable(GL_STENCIL_TEST);
    }

private:
    ReceiverFinder finder_;
    ProjectedCasters casters_;
};

} // namespace

Entry planarHard() {
    return {.id = "planar-hard",
            .title = "Projected shadow on a plane",
            .source = {Document::Zapotocky, "2.2"},
            .answer = Answer::Hard,
            .lacks = {Need::AnyReceiver},
            .notApplicable = noPlanarReceiver,
            .parameters = {},
            .variants = {""},
            .make = [](const Parameters&) { return std::make_unique<PlanarHard>(); }};
}

} // namespace shadowbench::techniques
