// Ray-traced soft shadows under a denoiser guided by variance (Schied et al. 2017): 1. a ray a pixel, or a few  2. means
// over frames of visibility and its moments, where the pixel's point was seen before  3. its variance  4. iterations of an
// à-trous filter, ever wider, that keep to the surface and to what visibilities may differ by; what the first has filtered
// is the next frame's history. The row of all defaults has the paper's figures; the second is AnKi's: three iterations that
// no variance guides. Departures: visibility is filtered in place of radiance; surfaces are compared by their planes, where
// the paper has the slope of depth.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/modern/surface.h"
#include "techniques/modern/traced_rays.h"

#include <optional>

namespace shadowbench::techniques {
namespace {

/// What is kept from frame to frame, and what a frame filters with.
struct Images {
    explicit Images(glm::ivec2 size)
        : noisy(gl::Format::R32F, size), mean(gl::Format::R32F, size), history(gl::Format::R32F, size),
          moments(gl::Format::RGBA32F, size), previousMoments(gl::Format::RGBA32F, size), filtered(gl::Format::RG32F, size),
          next(gl::Format::RG32F, size) {}

    gl::Texture noisy, mean, history, moments, previousMoments, filtered, next;
};

gl::Defines guidance(const Parameters& p) { return p.text("guided") == "on" ? gl::Defines{{"GUIDED", "1"}} : gl::Defines{}; }

class RayDenoised final : public Technique {
public:
    explicit RayDenoised(const Parameters& p)
        : iterations_(p.integer("iterations")), rays_(p.text("rays")),
          accumulate_(screen("accumulate", {{"SHARE", p.text("share")}})), variance_(screen("variance", {})),
          atrous_(screen("atrous", guidance(p))), shown_(screen("shown", {})) {}

    void reset() override {
        rays_.forget();
        images_.reset();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const bool known = images_ && images_->noisy.size() == frame.size;
        if (!known) images_.emplace(frame.size);
        rays_.draw(frame, images_->noisy, "rays");
        accumulate(frame, known);
        variance_.set("mean", images_->mean).set("moments", images_->moments);
        bindSurfaces(frame, variance_);
        resolve(frame, {&images_->filtered}, variance_, "variance");
        for (int i = 0; i < iterations_; ++i) filter(frame, i);
        show(frame, visibility);
        std::swap(images_->moments, images_->previousMoments);
    }

private:
    static gl::Program screen(const std::string& file, const gl::Defines& defines) {
        return gl::Program::screen("modern/ray-denoised/" + file + ".frag", defines);
    }

    void accumulate(const Frame& frame, bool hasHistory) {
        accumulate_.set("noisy", images_->noisy);
        bindSurfaces(frame, accumulate_);
        bindHistory(frame, accumulate_, images_->history, images_->previousMoments, hasHistory);
        resolve(frame, {&images_->mean, &images_->moments}, accumulate_, "accumulate");
    }

    void filter(const Frame& frame, int iteration) {
        atrous_.set("source", images_->filtered).set("spacing", 1 << iteration);
        bindSurfaces(frame, atrous_);
        resolve(frame, {&images_->next}, atrous_, "filter");
        std::swap(images_->filtered, images_->next);
        if (iteration == 0) show(frame, images_->history);
    }

    void show(const Frame& frame, const gl::Texture& to) {
        shown_.set("source", images_->filtered);
        resolve(frame, {&to}, shown_);
    }

    int iterations_;
    TracedRays rays_;
    gl::Program accumulate_, variance_, atrous_, shown_;
    std::optional<Images> images_;
};

} // namespace

Entry rayDenoised() {
    return {
        .id = "ray-denoised",
        .title = "A ray a pixel under a denoiser guided by variance",
        .source = {Document::Other, "Schied et al. 2017; AnKi"},
        .answer = Answer::Soft,
        .temporal = true,
        .computed = TracedRays::computed,
        .parameters = {{"iterations", "5", IntegerRange{1, 8}, "of the à-trous filter, each twice as wide as the one before",
                        "Schied et al. 2017: 5; AnKi: 3"},
                       {"guided", "on", OneOf{{"on", "off"}}, "keep visibilities apart that differ by more than their noise",
                        "Schied et al. 2017, eq. 5; AnKi: off"},
                       {"share", "0.2", RealRange{0.01, 1}, "of the newest frame in the means", "Schied et al. 2017: 0.2"},
                       {"rays", "1", IntegerRange{1, 16}, "a pixel and frame, each to another point of the light",
                        "Schied et al. 2017: 1"}},
        .variants = {"", "iterations=3,guided=off"},
        .make = [](const Parameters& p) { return std::make_unique<RayDenoised>(p); }};
}

} // namespace shadowbench::techniques
