// Layered attenuation maps (Agrawala, Ramamoorthi, Heirich, Moll 2000): Scherzer 2.3.5.
// 1. a depth map from each of N points of the light  2. each of its texels is warped into the view from the light's centre
// and put into the list of the texel that it falls into: points of about one depth are one layer  3. a layer's attenuation
// is the share of the N points that see it  4. a receiver takes that of the layer at its own depth, and is black if there is
// none. Steps 1 to 3 are made again only when light or casters have moved: as long as they stand still, a frame costs less
// than one with a shadow map. A surface that covers a small part of a texel, at its rim or seen edge-on, is missed by some
// points' texels and too dark there.
// Departures: a layer keeps the points that see it as bits, where the paper counts texels: a surface that is wider in a
// point's own view than in the centre's would count twice; for the same reason the points' maps have more texels than the
// layered one, or a surface that is narrower there would be missed. Layers lie at fixed depths, so that their order does not
// matter, and a receiver takes all layers that its plane crosses within its texel.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/contract/surroundings.h"
#include "techniques/sampled/layered-attenuation/attenuation_map.h"
#include "techniques/shared/maps/light_receiver.h"
#include "techniques/shared/sampling/light_points.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace shadowbench::techniques {
namespace {

class LayeredAttenuation final : public Technique {
public:
    explicit LayeredAttenuation(const Parameters& p)
        : count_(p.integer("n")), pattern_(p.text("pattern")),
          map_(p.integer("map"), p.integer("oversampling"), count_, p.real("thickness")),
          resolve_(gl::Program::screen("sampled/layered-attenuation/layered-attenuation.frag", attenuationDefines(count_))) {
    }

    void reset() override { builtFor_.reset(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        Surroundings now(frame);
        rebuilt_ = builtFor_ != now;
        if (rebuilt_) map_.build(frame, lightPoints(frame.snapshot.light, pattern_, count_, frame.seed));
        builtFor_ = std::move(now);
        map_.bindTo(resolve_);
        setLightReceiver(resolve_, map_.view(), true);
        resolve_.set("positions", frame.gbuffer.position()).set("normals", frame.gbuffer.normal());
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        double filled = 0, layers = 0;
        for (const int depth : map_.depths()) {
            filled += depth > 0 ? 1 : 0;
            layers += depth;
        }
        return {{"maps", rebuilt_ ? count_ : 0}, {"filled_texels", filled}, {"layers", layers}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(map_.view(), world, glm::dvec2(map_.side()));
    }

private:
    int count_;
    std::string pattern_;
    AttenuationMap map_;
    gl::Program resolve_;
    std::optional<Surroundings> builtFor_;
    bool rebuilt_ = false; // in the frame rendered last
};

} // namespace

Entry layeredAttenuation() {
    return {
        .id = "layered-attenuation",
        .title = "Layered attenuation map",
        .source = {Document::Dissertation, "2.3.5"},
        .answer = Answer::Soft,
        .parameters = {{"n", "64", IntegerRange{1, 256},
                        "light samples, one depth map each where light or casters have moved", "Zápotocký 5.2 (64 and 100)"},
                       lightPatternParameter(),
                       {"map", "1024", IntegerRange{16, 2048}, "texels per side of the layered map", ""},
                       {"oversampling", "2", IntegerRange{1, 4},
                        "texels of a light sample's depth map for one of the layered map, along each side", ""},
                       {"thickness", "1", RealRange{0.01, 100}, "of a layer, in widths of a texel", ""}},
        .figures = {{"maps", "depth maps drawn in the frame"},
                    {"filled_texels", "texels of the layered map that some light sample sees something in"},
                    {"layers", "layers of all texels"}},
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<LayeredAttenuation>(p); }};
}

} // namespace shadowbench::techniques
