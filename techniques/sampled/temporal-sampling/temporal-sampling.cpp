// One sample of the light a frame, averaged over time (Scherzer, dissertation 4.1.2; upper rows of Fig. 4.5 and 4.6): each
// frame draws one shadow map from one Halton point of the light and adds its hard test to a reprojected shadow buffer (ρ, n
// and linear depth; RGBA16F, double-buffered, with overscan). What is shown is eq. 4.5 alone: no PCSS start, no smoothing,
// no regard to what moves (4.1.3 and 4.1.4; those are `temporal-soft`). On a still scene n frames are the mean of n maps.
// Departure: equal depths are those of eq. 4.8, which is relative; depth-test=absolute has eq. 4.4's. As the source admits,
// what is new has large errors: the first two frames differ by half the light.
#include "techniques/contract/entry.h"
#include "techniques/sampled/shadow_buffer.h"
#include "techniques/shared/maps/depth_map.h"

#include <memory>

namespace shadowbench::techniques {
namespace {

class TemporalSampling final : public Technique {
public:
    explicit TemporalSampling(const Parameters& p)
        : buffer_(p), map_(p.integer("map"), biasFrom(p), Lookup::Compare),
          resolve_(gl::Program::screen("sampled/temporal-sampling/temporal-sampling.frag", shadowBufferDefines(p))) {}

    void reset() override { buffer_.reset(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        buffer_.begin(frame);
        const LightView view = lightSampleView(frame);
        map_.draw(view, frame);
        resolve_.set("mapFromWorld", mapFromWorld(view)).set("depthMap", map_.texture());
        buffer_.update(frame, resolve_, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override { return buffer_.figures(1); }

private:
    ShadowBuffer buffer_;
    DepthMap map_;
    gl::Program resolve_;
};

} // namespace

Entry temporalSampling() {
    return {.id = "temporal-sampling",
            .title = "One light sample a frame, averaged over time",
            .source = {Document::Dissertation, "4.1.2, eq. 4.5"},
            .answer = Answer::Soft,
            .temporal = true,
            .lacks = {Need::MovingLight, Need::MovingCasters},
            .parameters = withDepthMapParameters(shadowBufferParameters()),
            .figures = shadowBufferFigures(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<TemporalSampling>(p); }};
}

} // namespace shadowbench::techniques
