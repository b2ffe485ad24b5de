// Stencil shadow volumes, depth-fail (Everitt–Kilgard, course "Practical and robust stenciled shadow volumes";
// Zápotocký 2.4.4). Back faces that fail the depth test increment, front faces decrement, both in one pass with wrapping
// two-sided stencil; a pixel whose count ends at zero is lit. Vertices at infinity are homogeneous; `far=clamp` keeps the
// camera's far plane and clamps depth (the paper's section 4.2), `far=infinity` draws depth again under P_inf. A caster
// whose volume keeps clear of the near plane is counted by depth-pass, which needs no caps and counts the same (the paper's
// section 3.4; "slower than depth-pass and therefore should be used only when necessary", Zápotocký 2.4.4); `test=zfail`
// counts all by depth-fail. Casters whose volumes no pixel's ray can meet are left out.
// Departures: at most 255 placements are counted together, since 256 volumes around a point wrap to a count of none; the
// paper asks for a stencil of as many bits as the scene needs (its section 3.1). Caps are pushed away a little
// (stencil_volumes.cpp): a front cap at the same depth as the surface that it lies on may round to before it.
#include "techniques/contract/entry.h"
#include "techniques/gl/api.h"
#include "techniques/volumes/stencil_volumes.h"

#include <memory>
#include <optional>

namespace shadowbench::techniques {
namespace {

class VolumeZfail final : public Technique {
public:
    explicit VolumeZfail(const Parameters& p)
        : far_(p.text("far") == "infinity" ? FarPlane::AtInfinity : FarPlane::OfCamera),
          volumes_(p.text("test") == "zfail" ? VolumeTest::DepthFail : VolumeTest::PerCaster, far_),
          depth_("volumes/volume-zfail/depth.vert", "gl/depth_only.frag") {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const bool infinite = far_ == FarPlane::AtInfinity;
        const gl::Texture& depthStencil = infinite ? drawDepth(frame) : frame.gbuffer.depthStencil();
        volumes_.render(frame, frame.hardLight.homogeneous(), depthStencil, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        return volumes_.figures(far_ == FarPlane::AtInfinity ? *ownDepth_ : frame.gbuffer.depthStencil());
    }

private:
    const gl::Texture& drawDepth(const Frame& frame) {
        const auto pass = frame.pass("depth prepass");
        if (!ownDepth_ || ownDepth_->size() != frame.size) ownDepth_.emplace(gl::Format::Depth32FStencil8, frame.size);
        const gl::RenderTarget target({&*ownDepth_});
        target.clearDepth(1);
        target.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        depth_.set("clipFromWorld", glm::mat4(clipFromWorld(frame, far_))).use();
        frame.scene.draw();
        return *ownDepth_;
    }

    FarPlane far_;
    StencilVolumes volumes_;
    gl::Program depth_;
    std::optional<gl::Texture> ownDepth_;
};

} // namespace

Entry volumeZfail() {
    return {.id = "volume-zfail",
            .title = "Stencil shadow volumes, depth-fail",
            .source = {Document::Course, "Practical and Robust Stenciled Shadow Volumes; Zápotocký 2.4.4"},
            .answer = Answer::Hard,
            .lacks = {Need::OpenMeshes},
            .parameters = {{"far", "clamp", OneOf{{"clamp", "infinity"}},
                            "clamp depth, or put the far plane at infinity (P_inf)", "course, 3.2.1 and 3.4"},
                           {"test", "per-caster", OneOf{{"per-caster", "zfail"}},
                            "depth-pass for casters whose volumes the near plane does not cut, or depth-fail for all",
                            "course, 3.4"}},
            .figures = volumeFigures(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<VolumeZfail>(p); }};
}

} // namespace shadowbench::techniques
