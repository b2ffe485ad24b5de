// Physically correct soft shadows over time (Scherzer, dissertation chapter 4, listing 6.2): each frame draws one shadow map
// from one Halton point of the light and adds its test to a reprojected shadow buffer (ρ, n, linear depth, mean blocker
// depth; RGBA16F, double-buffered, with overscan). New pixels, and those shadowed by something that moves, start from PCSS
// 16+16. While the estimated standard error is at least 1/50 what is shown is smoothed over the estimated penumbra; the
// buffer is not. Departures: eq. 4.6's near/depth projection is written as pixels per metre at the receiver; the filter's
// disk has the penumbra width as its diameter and takes neighbours whose depth agrees by eq. 4.8; the tolerance of eq. 4.8,
// which the dissertation leaves open, is a parameter.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/pcss_program.h"
#include "techniques/shared/sampling/sampling.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

namespace shadowbench::techniques {

namespace {

constexpr PcssTaps startTaps{16, 16, false};
constexpr int filterTaps = 16;

class TemporalSoft final : public Technique {
public:
    explicit TemporalSoft(const Parameters& p)
        : start_(p.integer("start")), threshold_(static_cast<float>(p.real("threshold"))),
          epsilon_(static_cast<float>(p.real("epsilon"))), overscan_(p.real("overscan")),
          followPlane_(p.text("bias") == "slope"), map_(p.integer("map"), biasFrom(p)),
          resolve_(gl::Program::screen("sampled/temporal-soft/temporal-soft.frag", defines())),
          copy_(gl::Program::screen("sampled/temporal-soft/inner_part.frag")) {}

    void reset() override { buffers_.reset(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const bool fresh = !buffers_ || buffers_->size != frame.size;
        if (fresh) buffers_.emplace(frame.size, static_cast<int>(std::ceil(0.5 * overscan_ * frame.size.x)));
        gl::GBuffer& wide = buffers_->gbuffer;
        drawWide(frame, wide);

        const Light& light = frame.snapshot.light;
        const std::uint32_t i = haltonIndex(frame.index, frame.seed);
        const LightView view =
            fitFromSample(light, light.sample({halton(i, 2), halton(i, 3)}), boundingCorners(frame.snapshot));
        map_.draw(view, frame);

        setPcss(resolve_, startTaps, light, view, map_, followPlane_);
        setFrame(frame, wide, fresh);
        resolve(frame, {&buffers_->shown, &buffers_->write}, resolve_, "temporal resolve");
        std::swap(buffers_->read, buffers_->write);

        copy_.set("wide", buffers_->shown).set("border", wide.border());
        resolve(frame, {&visibility}, copy_, "crop");
    }

private:
    /// The shadow buffer and what it is drawn from, overscan included.
    struct Buffers {
        Buffers(glm::ivec2 inner, int border)
            : size(inner), gbuffer(inner, border), read(gl::Format::RGBA16F, gbuffer.size(), gl::Filter::Linear),
              write(gl::Format::RGBA16F, gbuffer.size(), gl::Filter::Linear), shown(gl::Format::R32F, gbuffer.size()) {}
        glm::ivec2 size;
        gl::GBuffer gbuffer;
        gl::Texture read, write, shown;
    };

    static void drawWide(const Frame& frame, gl::GBuffer& wide) {
        const auto pass = frame.pass("overscan G-buffer");
        wide.draw(frame.scene, frame.clipFromWorld);
    }

    static gl::Defines defines() {
        gl::Defines result = startTaps.defines();
        result.emplace_back("NEIGHBOUR_TAPS", std::to_string(filterTaps));
        return result;
    }

    void setFrame(const Frame& frame, const gl::GBuffer& wide, bool fresh) {
        static const std::vector<glm::vec2> neighbours = poissonTaps(filterTaps, Region::Disk);
        const Camera& camera = frame.snapshot.camera;
        const glm::dvec3 forward = camera.basis().forward;
        const glm::dvec3 previousForward = frame.snapshot.previousCamera.basis().forward;
        const Light& light = frame.snapshot.light;
        const double lightSize = 0.5 * (glm::length(light.u) + glm::length(light.v));
        const double pixelsPerMetre = 0.5 * frame.size.y / std::tan(0.5 * glm::radians(camera.fovy)); // at unit distance
        const auto plane = [](const glm::dvec3& axis, const glm::dvec3& eye) {
            return glm::vec4(glm::dvec4(axis, -glm::dot(axis, eye)));
        };
        resolve_.set("positions", wide.position())
            .set("normals", wide.normal())
            .set("previousPositions", wide.previousPosition())
            .set("shadowBuffer", buffers_->read)
            .set("previousClipFromWorld", glm::mat4(wide.widened(frame.previousClipFromWorld)))
            .set("eyeDepth", plane(forward, camera.eye))
            .set("previousEyeDepth", plane(previousForward, frame.snapshot.previousCamera.eye))
            .set("lightSizeInPixels", static_cast<float>(lightSize * pixelsPerMetre))
            .set("neighbourTaps", neighbours)
            .set("threshold", threshold_)
            .set("epsilon", epsilon_)
            .set("start", static_cast<float>(start_))
            .set("hasHistory", fresh ? 0 : 1);
    }

    int start_;
    float threshold_, epsilon_;
    double overscan_;
    bool followPlane_;
    LinearDepthMap map_;
    gl::Program resolve_, copy_;
    std::optional<Buffers> buffers_;
};

} // namespace

Entry temporalSoft() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"start", "1", IntegerRange{0, 64}, "samples that the PCSS start counts for; 0 starts from the first sample alone",
         "dissertation 4.1.3, Fig. 4.6"},
        {"threshold", "0.02", RealRange{0, 1}, "standard error from which what is shown is smoothed over the penumbra",
         "dissertation 4.2"},
        {"epsilon", "0.01", RealRange{1e-5, 1}, "relative depth tolerance of reprojection", "dissertation eq. 4.8"},
        {"overscan", "0.05", RealRange{0, 0.5}, "share by which the shadow buffer is larger than the image",
         "dissertation 4.2"},
    });
    return {.id = "temporal-soft",
            .title = "Physically correct soft shadows over time",
            .source = {Document::Dissertation, "4, listing 6.2"},
            .answer = Answer::Soft,
            .temporal = true,
            .parameters = std::move(parameters),
            .variants = {"", "start=0,threshold=1"}, // the second is eq. 4.5 alone (Fig. 4.5, upper row)
            .make = [](const Parameters& p) { return std::make_unique<TemporalSoft>(p); }};
}

} // namespace shadowbench::techniques
