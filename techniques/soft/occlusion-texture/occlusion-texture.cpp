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

namespace shadowbench::techniques {
namespace {

class OcclusionTexture final : public Technique {
public:
    explicit OcclusionTexture(const Parameters& p)
        : slices_(p.integer("slices")),
          layers_(p.integer("map"), gl::Program("shared/maps/linear_depth_map.vert", "soft/occlusion-texture/slices.frag")),
          resolve_(gl::Program::screen("soft/occlusion-texture/occlusion-texture.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const LightView view = fitToScene(frame.snapshot.light, frame.snapshot);
        const auto thickness = static_cast<float>((1 / view.near - 1 / view.far) / slices_); // of a slice, in 1 / depth
        layers_.program().set("inverseRange", inverseRange(view)).set("thickness", thickness).set("slices", slices_);
        const std::vector<bool> all(boundingCorners(frame.snapshot).size() / 8, true);
        layers_.draw(view, frame, all, "slices");
        layers_.sum(frame, slices_);

        layers_.bindTo(resolve_, frame.snapshot.light, view);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(view))
            .set("depthFromWorld", glm::vec4(view.depthFromWorld))
            .set("inverseNear", static_cast<float>(1 / view.near))
            .set("thickness", thickness)
            .set("slices", slices_);
        resolve(frame, {&visibility}, resolve_);
    }

private:
    int slices_;
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
