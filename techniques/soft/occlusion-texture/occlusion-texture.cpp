// Occlusion textures (Eisemann and Décoret 2006 and 2008), after Scherzer 2.3.3:
// 1. the scene is cut into slices parallel to the light, all of them in one pass: a fragment sets the bit of its slice in
// the
//    texel of a map that is seen from the light's centre;
// 2. each slice is filtered beforehand, so that a box of any size costs the same;
// 3. a receiver reads from every slice before it the mean oᵢ over the light as it appears through the slice; visibility is
//    the product of 1 − oᵢ.
// The product takes slices for independent: occluders one behind the other with the same outline darken twice, and light
// leaks along lines where a surface goes from one slice into the next. Departures: slices are equally thick in 1 / depth, so
// that all err by the same width of penumbra; the box is the mean of summed areas; the slice right before a receiver counts
// by the receiver's way into its own slice, so that slanted surfaces do not shadow themselves where slices meet.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/occluder_layers.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <algorithm>

namespace shadowbench::techniques {
namespace {

class OcclusionTexture final : public Technique {
public:
    explicit OcclusionTexture(const Parameters& p)
        : slices_(p.integer("slices")),
          layers_(p.integer("map"), gl::Program("shared/maps/linear_depth_map.vert", "soft/occlusion-texture/slices.frag")),
          resolve_(gl::Program::screen("soft/occlusion-texture/occlusion-texture.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        layers_.program()
            .set("inverseRange", inverseRange(view_))
            .set("thickness", static_cast<float>(thickness()))
            .set("slices", slices_);
        layers_.draw(view_, frame, allShown(frame.snapshot), "slices");
        layers_.sum(frame, slices_);

        layers_.bindTo(resolve_, frame.snapshot.light, view_);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(view_))
            .set("depthFromWorld", glm::vec4(view_.depthFromWorld))
            .set("inverseNear", static_cast<float>(1 / view_.near))
            .set("thickness", static_cast<float>(thickness()))
            .set("slices", slices_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        std::vector<BarePass> passes =
            layers_.bare(view_, allShown(frame.snapshot), "slices", "dissertation 2.3.3: all slices in one pass", slices_);
        const int reads = meanReads(frame, view_, [this](double depth, unsigned) {
            return std::clamp(static_cast<int>((1 / view_.near - 1 / depth) / thickness()), 0, slices_);
        });
        passes.push_back(bareLookup("resolve", "the mean over the light in each slice before a pixel", frame.size,
                                    {{gl::Format::R32F, layers_.bits().size(), Read::Linear, reads}}));
        return passes;
    }

private:
    static std::vector<bool> allShown(const Snapshot& snapshot) {
        return std::vector<bool>(boundingCorners(snapshot).size() / 8, true);
    }

    /// Of a slice, in 1 / depth.
    [[nodiscard]] double thickness() const { return (1 / view_.near - 1 / view_.far) / slices_; }

    int slices_;
    LightView view_; // of the frame rendered last
    OccluderLayers layers_;
    gl::Program resolve_;
};

} // namespace

Entry occlusionTexture() {
    return {.id = "occlusion-texture",
            .title = "Occlusion textures",
            .source = {Document::Dissertation, "2.3.3"},
            .answer = Answer::Soft,
            .parameters = {{"map", "1024", IntegerRange{16, widestLayer}, "texels per side of the occlusion textures",
                            "EGSR paper, 4"},
                           {"slices", "16", IntegerRange{1, mostLayers}, "slices of the scene, parallel to the light", ""}},
            .variants = {"", "slices=8"},
            .make = [](const Parameters& p) { return std::make_unique<OcclusionTexture>(p); }};
}

} // namespace shadowbench::techniques
