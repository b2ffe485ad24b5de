// Cascaded shadow maps: the view frustum is cut into slices along the view axis, each with a shadow map of its own, focused
// on what of the scene the slice holds (Tadamura et al. 1999; Engel 2007; practical split of Zhang et al. 2006).
// Scherzer 2.2.2, Fig. 2.11. The slices share the texels of one map of `map`². `warp=lispsm` warps each slice's map (LSPSM)
// as on the right of Fig. 2.11.
// `fit=visible` is the sample distribution shadow map of Lauritzen, Salvi and Lefohn 2011: the depths that are split, and
// the slices' boxes in light space, are those of the points that the G-buffer shows. Steps are geometrical there (λ = 1),
// which leaves every slice the same ratio of depths; the practical split mixes in even steps only because depths that no
// pixel has would otherwise take most slices. Departure: the numbers that the reduction leaves are read back. `fit=view` is
// the older way, from the frustum and the scene's bounding box. Departure: depths between the nearest and farthest visible
// point of that box are split, not those between the camera's near and far plane. With `stable=texels` they are the
// camera's, so that the map of a slice neither grows nor turns (Valient, ShaderX6); lights other than directional ones are
// fitted as without it. Blending is off by default: the answer is a hard shadow, and where two maps differ a blend is
// neither.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/light_views/visible_part.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "techniques/shared/maps/receiver_bounds.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

std::optional<std::string> unstableFit(const Parameters& p) {
    if (p.text("stable") == "none" || (p.text("fit") == "view" && p.text("warp") == "none")) return std::nullopt;
    return "texels that stay in place need a map that neither what is seen nor a warp changes: stable=texels goes with "
           "fit=view and warp=none";
}

gl::Defines resolveDefines(const Parameters& p) {
    gl::Defines defines{{"TILES", p.text("slices")}};
    if (p.real("blend") > 0) defines.emplace_back("BLEND", "1");
    return defines;
}

class Cascaded final : public Technique {
public:
    explicit Cascaded(const Parameters& p)
        : slices_(p.integer("slices")), lambda_(p.real("lambda")), blend_(p.real("blend")),
          warped_(p.text("warp") == "lispsm"), stable_(p.text("stable") == "texels"),
          atlas_(squareTiles(p.integer("map"), slices_), biasFrom(p)),
          resolve_(gl::Program::screen("maps/sm-cascaded/sm-cascaded.frag", resolveDefines(p))) {
        if (p.text("fit") == "visible") receivers_.emplace(slices_);
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Camera& camera = frame.snapshot.camera;
        const glm::dvec3 forward = camera.basis().forward;
        eyeDepthFromWorld_ = glm::dvec4(forward, -glm::dot(forward, camera.eye));
        const DepthRange depths = splitDepths(frame);
        splits_ = practicalSplits(depths.near, depths.far, slices_, lambda_);
        fitSlices(frame, sliceRanges(splits_, blend_));
        atlas_.draw(views_, frame, casters_);

        std::vector<glm::vec4> ends;
        for (std::size_t i = 0; i + 1 < splits_.size(); ++i)
            ends.emplace_back(splits_[i + 1], splits_[i + 1] - blend_ * (splits_[i + 1] - splits_[i]), 0, 0);
        atlas_.bindTo(resolve_);
        resolve_.set("positions", frame.gbuffer.position());
        if (slices_ > 1) resolve_.set("eyeDepthFromWorld", glm::vec4(eyeDepthFromWorld_)).set("sliceEnds", ends);
        resolve(frame, {&visibility}, resolve_);
    }

    /// In the slice's own map where two are blended.
    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return atlas_.pointAt(sliceOf(splits_, glm::dot(eyeDepthFromWorld_, glm::dvec4(world, 1))), world);
    }

private:
    [[nodiscard]] DepthRange splitDepths(const Frame& frame) {
        const Camera& camera = frame.snapshot.camera;
        const DepthRange planes{camera.near, camera.far};
        if (receivers_) return receivers_->depths(frame, eyeDepthFromWorld_).value_or(planes);
        return stable_ ? planes : visibleDepths(frame.snapshot.bounds(), camera, frame.aspect());
    }

    /// A view and its casters for each range of depths; no casters where a slice has no receivers.
    void fitSlices(const Frame& frame, const std::vector<DepthRange>& ranges) {
        const LightView whole = fitToScene(frame.hardLight, frame.snapshot);
        std::vector<std::optional<Bounds>> boxes(ranges.size());
        if (receivers_) boxes = receivers_->boxes(frame, eyeDepthFromWorld_, ranges, whole.clipFromWorld);
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        views_.clear();
        casters_.clear();
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const bool empty = receivers_ && !boxes[i];
            views_.push_back(empty ? whole : sliceView(frame, i, ranges[i], whole, boxes[i]));
            casters_.push_back(empty ? std::vector<bool>(corners.size() / 8, false) : castersIn(views_[i], corners));
        }
    }

    /// `receivers`: their box in the clip space of `whole`.
    [[nodiscard]] LightView sliceView(const Frame& frame, std::size_t i, const DepthRange& range, const LightView& whole,
                                      const std::optional<Bounds>& receivers) const {
        Camera slice = frame.snapshot.camera;
        slice.near = range.near;
        slice.far = range.far;
        const Light& light = frame.hardLight;
        if (stable_ && light.kind == LightKind::Directional)
            return fitStable(light, frame.snapshot, slice, frame.aspect(), atlas_.tiles()[i].size.x);
        std::vector<glm::dvec4> within;
        if (receivers) {
            Bounds box = *receivers;
            box.low -= leastHalf;
            box.high += leastHalf;
            for (const glm::dvec4& plane : frustumPlanes(fitMatrix(box, 0) * whole.clipFromWorld)) within.push_back(plane);
        }
        return (warped_ ? fitLispsm : fitFocused)(light, frame.snapshot, slice, frame.aspect(), within);
    }

    /// What a box of receivers is widened by on every side, so that one of a single point is a body and that point does not
    /// lie on its near plane, to which nearer casters are clamped. Of the scene's map, from −1 to 1.
    static constexpr double leastHalf = 1e-5;

    int slices_;
    double lambda_, blend_;
    bool warped_, stable_;
    std::optional<ReceiverBounds> receivers_; // fit=visible
    DepthAtlas atlas_;
    gl::Program resolve_;

    // Of the frame rendered last.
    std::vector<double> splits_; // eye depths at which slices meet
    glm::dvec4 eyeDepthFromWorld_{0};
    std::vector<LightView> views_;
    std::vector<std::vector<bool>> casters_; // of each slice
};

} // namespace

Entry smCascaded() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"slices", "4", IntegerRange{1, 8}, "parts of the view frustum; their maps have map² texels together",
         "dissertation, Fig. 2.11"},
        {"fit", "visible", OneOf{{"visible", "view"}},
         "what slices are fitted to: the points that the G-buffer shows, or the frustum within the scene's box",
         "Lauritzen et al. 2011"},
        {"lambda", "1", RealRange{0, 1},
         "share of geometrical (1) against even (0) steps between slices; 0.5 is the practical split's",
         "Lauritzen et al. 2011"},
        {"warp", "none", OneOf{{"none", "lispsm"}}, "warp of each slice's map", "dissertation, Fig. 2.11"},
        {"stable", "none", OneOf{{"none", "texels"}},
         "maps of a directional light as large as the slice's ball, moved by whole texels (with fit=view)",
         "Valient, ShaderX6"},
        {"blend", "0", RealRange{0, 0.5}, "share of a slice, at its end, over which the next slice's map takes over",
         "Valient, ShaderX6"},
    });
    return {.id = "sm-cascaded",
            .title = "Cascaded shadow maps",
            .source = {Document::Dissertation, "2.2.2, Fig. 2.11"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .contradiction = unstableFit,
            .variants = {"", "fit=view,lambda=0.5", "slices=2,warp=lispsm"},
            .make = [](const Parameters& p) { return std::make_unique<Cascaded>(p); }};
}

} // namespace shadowbench::techniques
