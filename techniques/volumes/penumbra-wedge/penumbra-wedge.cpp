// Soft shadow volumes (Akenine-Möller, Assarsson 2002; Assarsson, Dougherty, Mounier, Akenine-Möller 2003; course, "A Soft
// Shadow Volume Algorithm"):
// 1. the casters' silhouette edges as the light's middle sees them  2. hard shadow quads, which count in the V-buffer what
// hides the middle from each pixel's surface point  3. a penumbra wedge over each edge; where a point lies within, the edge
// is projected onto the light, and what lies behind it there (its coverage) is subtracted where the quad hides the middle,
// else added  4. what the V-buffer leaves of one is visible. Exact for one planar polygon, and for what has the same
// silhouette from all of the light. Wrong, as the course says, where the silhouette changes over the light, as a cube's
// does, and where casters overlap: each hides its share, as if of light of its own. The course's remedy for both is a light
// of 2 × 2 or 3 × 3 parts, each with silhouettes of its own.
// Departures: quads are counted by depth-pass, begun with the layers around the eye, not by depth-fail; and before or behind
// a quad is decided by the very sign with which the wedges add or subtract, not by depth, for a point that the two judged
// differently would be all lit or all dark. Coverage has a closed form and needs no table. Points beyond a wedge's far side
// are left out by a depth test, those before it by the projection, not by counting each wedge in the stencil buffer. The
// V-buffer is one of floats. A disk is not divided, for its parts would be no disks.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/volumes/penumbra_wedges.h"

#include <memory>
#include <optional>

namespace shadowbench::techniques {
namespace {

/// side × side equal parts of a rectangle; a disk as it is.
std::vector<Light> partsOf(const Light& light, int side) {
    if (light.kind != LightKind::Rectangle) return {light};
    std::vector<Light> parts;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            Light part = light;
            part.centre = light.sample({(column + 0.5) / side, (row + 0.5) / side});
            part.u /= side;
            part.v /= side;
            parts.push_back(part);
        }
    return parts;
}

class PenumbraWedge final : public Technique {
public:
    explicit PenumbraWedge(const Parameters& p)
        : side_(p.integer("side")), coverage_("volumes/wedge.vert", "volumes/penumbra-wedge/penumbra-wedge.frag"),
          add_(gl::Program::screen("volumes/penumbra-wedge/add.frag")),
          mean_(gl::Program::screen("shared/sampling/mean.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!images_ || images_->sum.size() != frame.size) images_.emplace(frame.size);
        images_->sumTarget.clearColour(0, glm::vec4(0));
        const std::vector<Light> parts = partsOf(frame.snapshot.light, side_);
        count_ = {};
        for (const Light& part : parts) {
            hide(frame, part);
            addVisible(frame);
        }
        mean_.set("sum", images_->sum).set("count", static_cast<float>(parts.size()));
        resolve(frame, {&visibility}, mean_, "mean");
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override { return count_.figures(); }

private:
    struct Images {
        explicit Images(glm::ivec2 size) : hidden(gl::Format::R32F, size), sum(gl::Format::R32F, size), sumTarget{&sum} {}
        gl::Texture hidden; // the V-buffer of one part of the light
        gl::Texture sum;    // what is visible of all
        gl::RenderTarget sumTarget;
    };

    void hide(const Frame& frame, const Light& part) {
        wedges_.build(frame, part);
        count_ += wedges_.count();
        wedges_.countLayers(frame, images_->hidden);
        const auto pass = frame.pass("penumbra wedges");
        coverage_.set("positions", frame.gbuffer.position())
            .set("unitLightFromWorld", glm::mat4(unitLightFromWorld(part)))
            .set("middle", glm::vec3(part.centre))
            .set("disk", part.kind == LightKind::Disk ? 1 : 0);
        wedges_.draw(frame, coverage_, gl::RenderTarget({&images_->hidden, &frame.gbuffer.depthStencil()}));
    }

    void addVisible(const Frame& frame) {
        const auto pass = frame.pass("light sum");
        add_.set("hidden", images_->hidden);
        images_->sumTarget.bind();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        add_.drawScreen();
        glDisable(GL_BLEND);
    }

    int side_; // parts of the light along u, and along v
    PenumbraWedges wedges_{Silhouettes::OfMiddle};
    gl::Program coverage_, add_, mean_;
    std::optional<Images> images_;
    WedgeCount count_; // of all parts in the frame rendered last
};

} // namespace

Entry penumbraWedge() {
    return {.id = "penumbra-wedge",
            .title = "Soft shadow volumes (penumbra wedges)",
            .source = {Document::Course, "A Soft Shadow Volume Algorithm"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutArea,
            .parameters = {{"side", "1", IntegerRange{1, 8},
                            "parts of a rectangle along each of its sides, each with silhouettes of its own",
                            "course, Figures 8 and 9"}},
            .figures = wedgeFigures(),
            .variants = {"", "side=2", "side=3"},
            .make = [](const Parameters& p) { return std::make_unique<PenumbraWedge>(p); }};
}

} // namespace shadowbench::techniques
