// Ray-traced soft shadows under the Shadow Denoiser of AMD FidelityFX, as its documentation has it (GPUOpen, FidelityFX SDK,
// Denoiser 1.2): 1. a ray a pixel  2. masks of what is free, a bit a ray, 8 × 4 pixels each  3. classes of tiles: where all
// rays around agree, that is the answer, and nothing else is done  4. the share of free rays over 17 × 17 pixels, by rows
// and then by columns; of zeros and ones it gives their variance, too  5. means over frames, clamped to half a standard
// deviation around that share: a history that lies far from it counts as young, and variance is raised while it is young  6.
// three steps of an edge-avoiding à-trous filter, the first of which makes the next frame's history  7. contrast. Figures
// are the SDK's; its filter weighs differences of depth by the metre, so it blurs more in a small model. Departures: shares
// of rows go through a texture, where compute shaders keep them in the group's memory; rays beside the image do not count,
// where the SDK has them shadowed; each pixel moves as its own point did, not as the nearest of four.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/modern/surface.h"
#include "techniques/modern/traced_rays.h"

#include <optional>

namespace shadowbench::techniques {
namespace {

/// What is kept from frame to frame, and what a frame classifies and filters with.
struct Images {
    explicit Images(glm::ivec2 size)
        : noisy(gl::Format::R32F, size), masks(gl::Format::R32UI, {(size.x + 7) / 8, (size.y + 3) / 4}),
          tiles(gl::Format::R32UI, (size + 7) / 8), rows(gl::Format::R32F, size), moments(gl::Format::RGBA32F, size),
          previousMoments(gl::Format::RGBA32F, size), history(gl::Format::RG32F, size, gl::Filter::Linear),
          filtered(gl::Format::RG32F, size), next(gl::Format::RG32F, size) {}

    gl::Texture noisy, masks, tiles, rows, moments, previousMoments, history, filtered, next;
};

class RayClassified final : public Technique {
public:
    explicit RayClassified(const Parameters& p)
        : rays_("1"), masks_(screen("masks")), tiles_(screen("tiles")), rows_(screen("rows")),
          accumulate_(screen("accumulate", {{"SHARE", p.text("share")}})), filter_(screen("filter")),
          shown_(screen("shown", {{"CONTRAST", p.text("contrast")}})) {}

    void reset() override {
        rays_.forget();
        images_.reset();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const bool known = images_ && images_->noisy.size() == frame.size;
        if (!known) images_.emplace(frame.size);
        rays_.draw(frame, images_->noisy, "rays");
        classify(frame);
        accumulate(frame, known);
        filter(frame, images_->filtered, images_->history, 1);
        filter(frame, images_->history, images_->next, 2);
        filter(frame, images_->next, images_->filtered, 4);
        shown_.set("source", images_->filtered);
        resolve(frame, {&visibility}, shown_);
        std::swap(images_->moments, images_->previousMoments);
    }

private:
    static gl::Program screen(const std::string& file, const gl::Defines& defines = {}) {
        return gl::Program::screen("modern/ray-classified/" + file + ".frag", defines);
    }

    void classify(const Frame& frame) {
        masks_.set("noisy", images_->noisy);
        resolve(frame, {&images_->masks}, masks_, "masks");
        tiles_.set("masks", images_->masks);
        resolve(frame, {&images_->tiles}, tiles_, "tiles");
        rows_.set("tiles", images_->tiles).set("masks", images_->masks).set("width", frame.size.x);
        resolve(frame, {&images_->rows}, rows_, "rows");
    }

    void accumulate(const Frame& frame, bool hasHistory) {
        bindSurfaces(frame, accumulate_);
        bindHistory(frame, accumulate_, images_->history, images_->previousMoments, hasHistory);
        accumulate_.set("tiles", images_->tiles)
            .set("noisy", images_->noisy)
            .set("rows", images_->rows)
            .set("eye", glm::vec3(frame.snapshot.camera.eye));
        resolve(frame, {&images_->filtered, &images_->moments}, accumulate_, "accumulate");
    }

    void filter(const Frame& frame, const gl::Texture& from, const gl::Texture& to, int spacing) {
        bindSurfaces(frame, filter_);
        filter_.set("tiles", images_->tiles).set("source", from).set("spacing", spacing);
        resolve(frame, {&to}, filter_, "filter");
    }

    TracedRays rays_;
    gl::Program masks_, tiles_, rows_, accumulate_, filter_, shown_;
    std::optional<Images> images_;
};

} // namespace

Entry rayClassified() {
    return {
        .id = "ray-classified",
        .title = "A ray a pixel under a denoiser of classified tiles",
        .source = {Document::Other, "AMD FidelityFX SDK, Denoiser 1.2"},
        .answer = Answer::Soft,
        .temporal = true,
        .computed = TracedRays::computed,
        .parameters = {{"share", "0.05", RealRange{0.01, 1}, "of the newest frame in the means, once eight are in them",
                        "FidelityFX: 0.05"},
                       {"contrast", "1.2", RealRange{1, 2},
                        "exponent of what is shown where no variance is left; 1: as it was filtered", "FidelityFX: 1.2"}},
        .variants = {"", "contrast=1"},
        .make = [](const Parameters& p) { return std::make_unique<RayClassified>(p); }};
}

} // namespace shadowbench::techniques
