// Cascaded shadow maps: the view frustum is cut into slices along the view axis, each with a shadow map of its own, focused
// on what of the scene the slice holds (Tadamura et al. 1999; Engel 2007; practical split of Zhang et al. 2006).
// Scherzer 2.2.2, Fig. 2.11. The slices share the texels of one map of `map`². `warp=lispsm` warps each slice's map (LSPSM)
// as on the right of Fig. 2.11. Departure: depths between the nearest and farthest visible point of the scene's box are
// partitioned, not those between the camera's near and far plane.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/maps/depth_atlas.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

class Cascaded final : public Technique {
public:
    explicit Cascaded(const Parameters& p)
        : slices_(p.integer("slices")), lambda_(p.real("lambda")), warped_(p.text("warp") == "lispsm"),
          atlas_(equalTiles(p.integer("map"), slices_), biasFrom(p)),
          resolve_(gl::Program::screen("maps/sm-cascaded/sm-cascaded.frag", {{"TILES", p.text("slices")}})) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Camera& camera = frame.snapshot.camera;
        const DepthRange depths = visibleDepths(frame.snapshot.bounds(), camera, frame.aspect());
        splits_ = practicalSplits(depths.near, depths.far, slices_, lambda_);
        const glm::dvec3 forward = camera.basis().forward;
        eyeDepthFromWorld_ = glm::dvec4(forward, -glm::dot(forward, camera.eye));

        std::vector<LightView> views;
        std::vector<glm::vec4> ends;
        for (std::size_t i = 0; i + 1 < splits_.size(); ++i) {
            Camera slice = camera;
            slice.near = splits_[i];
            slice.far = splits_[i + 1];
            const auto fit = warped_ ? fitLispsm : fitFocused;
            views.push_back(fit(frame.hardLight, frame.snapshot, slice, frame.aspect()));
            ends.emplace_back(splits_[i + 1], 0, 0, 0);
        }
        atlas_.draw(views, frame);

        atlas_.bindTo(resolve_);
        resolve_.set("positions", frame.gbuffer.position());
        if (slices_ > 1) resolve_.set("eyeDepthFromWorld", glm::vec4(eyeDepthFromWorld_)).set("sliceEnds", ends);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        return {atlas_.bare("dissertation 2.2.2: a map for each slice"),
                bareLookup("resolve", "dissertation 2.2.2: one test a pixel", frame.size,
                           {{gl::Format::Depth32F, atlas_.texture().size(), Read::Compare}})};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return atlas_.pointAt(sliceOf(splits_, glm::dot(eyeDepthFromWorld_, glm::dvec4(world, 1))), world);
    }

private:
    int slices_;
    double lambda_;
    bool warped_;
    std::vector<double> splits_; // eye depths at which slices meet, in the frame last rendered
    glm::dvec4 eyeDepthFromWorld_{0};
    DepthAtlas atlas_;
    gl::Program resolve_;
};

} // namespace

Entry smCascaded() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"slices", "4", IntegerRange{1, 8}, "parts of the view frustum; their maps have map² texels together",
         "dissertation, Fig. 2.11"},
        {"lambda", "0.5", RealRange{0, 1}, "share of geometrical (1) against even (0) steps between slices",
         "dissertation, 2.2.2"},
        {"warp", "none", OneOf{{"none", "lispsm"}}, "warp of each slice's map", "dissertation, Fig. 2.11"},
    });
    return {.id = "sm-cascaded",
            .title = "Cascaded shadow maps",
            .source = {Document::Dissertation, "2.2.2, Fig. 2.11"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Cascaded>(p); }};
}

} // namespace shadowbench::techniques
