// Physically correct soft shadows over time (Scherzer, dissertation chapter 4, listing 6.2): each frame draws one shadow map
// from one Halton point of the light and adds its test to a reprojected shadow buffer (ρ, n, linear depth, mean blocker
// depth; RGBA16F, double-buffered, with overscan). New pixels, and those shadowed by something that moves, start from PCSS
// 16+16. While the estimated standard error is at least 1/50 what is shown is smoothed over the estimated penumbra; the
// buffer is not. Departures: eq. 4.6's near/depth projection is written as pixels per metre at the receiver; the filter's
// disk has the penumbra width as its diameter and takes neighbours whose depth agrees by eq. 4.8; the tolerance of eq. 4.8,
// which the dissertation leaves open, is a parameter; that a shadow moves is read from a second map, of the casters that
// move alone, where the dissertation keeps a sign in the one map, so that this one is drawn as depth alone.
#include "techniques/contract/entry.h"
#include "techniques/sampled/shadow_buffer.h"
#include "techniques/sampled/temporal-soft/moving_casters.h"
#include "techniques/shared/filters/pcss_program.h"
#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

namespace shadowbench::techniques {
namespace {

constexpr PcssTaps startTaps{16, 16, false};
constexpr int filterTaps = 16;

class TemporalSoft final : public Technique {
public:
    explicit TemporalSoft(const Parameters& p)
        : start_(p.integer("start")), threshold_(static_cast<float>(p.real("threshold"))),
          followPlane_(p.text("bias") == "slope"), buffer_(p), map_(p.integer("map"), biasFrom(p)),
          movingCasters_(p.integer("map"), drawnBias(biasFrom(p))),
          resolve_(gl::Program::screen("sampled/temporal-soft/temporal-soft.frag", defines(p))) {}

    void reset() override { buffer_.reset(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        buffer_.begin(frame);
        const LightView view = lightSampleView(frame);
        map_.draw(view, frame);
        movingCasters_.draw(view, frame);
        setPcss(resolve_, startTaps, frame.snapshot.light, view, map_, followPlane_);
        setFilter(frame);
        buffer_.update(frame, resolve_, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return buffer_.figures(std::max(start_, 1));
    }

private:
    static gl::Defines defines(const Parameters& p) {
        gl::Defines result = shadowBufferDefines(p);
        for (auto& define : startTaps.defines()) result.push_back(std::move(define));
        result.emplace_back("NEIGHBOUR_TAPS", std::to_string(filterTaps));
        return result;
    }

    void setFilter(const Frame& frame) {
        static const std::vector<glm::vec2> neighbours = poissonTaps(filterTaps, Region::Disk);
        const Light& light = frame.snapshot.light;
        const double lightSize = 0.5 * (glm::length(light.u) + glm::length(light.v));
        const double fovy = glm::radians(frame.snapshot.camera.fovy);
        const double pixelsPerMetre = 0.5 * frame.size.y / std::tan(0.5 * fovy); // at unit distance
        resolve_.set("movingDepths", movingCasters_.texture())
            .set("lightSizeInPixels", static_cast<float>(lightSize * pixelsPerMetre))
            .set("neighbourTaps", neighbours)
            .set("threshold", threshold_)
            .set("start", static_cast<float>(start_));
    }

    int start_;
    float threshold_;
    bool followPlane_;
    ShadowBuffer buffer_;
    LinearisedMap map_;
    MovingCasters movingCasters_;
    gl::Program resolve_;
};

} // namespace

Entry temporalSoft() {
    std::vector<Parameter> parameters{
        {"start", "1", IntegerRange{0, 64}, "samples that the PCSS start counts for; 0 starts from the first sample alone",
         "dissertation 4.1.3, Fig. 4.6"},
        {"threshold", "0.02", RealRange{0, 1}, "standard error from which what is shown is smoothed over the penumbra",
         "dissertation 4.2"},
    };
    for (Parameter& parameter : shadowBufferParameters()) parameters.push_back(std::move(parameter));
    return {.id = "temporal-soft",
            .title = "Physically correct soft shadows over time",
            .source = {Document::Dissertation, "4, listing 6.2"},
            .answer = Answer::Soft,
            .temporal = true,
            .lacks = {Need::MovingLight, Need::MovingCasters},
            .parameters = withDepthMapParameters(std::move(parameters)),
            .figures = shadowBufferFigures(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<TemporalSoft>(p); }};
}

} // namespace shadowbench::techniques
