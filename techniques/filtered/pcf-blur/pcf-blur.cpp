// Blurred percentage-closer filtering (Shastry 2005; Zápotocký 3.3): the shadow is filtered twice, in the map and in the
// image.
// 1. PCF 3×3 into a texture of the image's size  2. a Gaussian of 15 taps along its rows  3. the same along its columns.
// Departures: the source leaves the Gaussian's width open (here a parameter, the taps' weights scaled to sum to 1); beyond
// the image's rim its outermost pixels repeat. As the source admits, the blur knows nothing of depth: what only looks
// adjacent in the image is mixed, so that a lit occluder has a lit halo over the shadow behind it, and a penumbra is as many
// pixels wide wherever its occluder is.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/pcf/pcf.h"
#include "techniques/gl/program.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr int reach = 7; // pixels to either side of the middle tap

double gaussian(double x, double sigma) { return std::exp(-0.5 * x * x / (sigma * sigma)); }

/// Offset in pixels and weight of the pairs of taps beside the middle one, whose weight is what is left of 1.
std::vector<glm::vec2> gaussianPairs(double sigma) {
    double sum = gaussian(0, sigma);
    for (int x = 1; x <= reach; ++x) sum += 2 * gaussian(x, sigma);
    std::vector<glm::vec2> pairs;
    for (int x = 1; x <= reach; ++x) pairs.emplace_back(x, gaussian(x, sigma) / sum);
    return pairs;
}

class PcfBlur final : public Technique {
public:
    explicit PcfBlur(const Parameters& p)
        : pcf_(makePcf(p)), pairs_(gaussianPairs(p.real("sigma"))),
          gaussian_(gl::Program::screen("filtered/pcf-blur/gaussian.frag", {{"PAIRS", std::to_string(reach)}})) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!images_ || images_->sharp.size() != frame.size) images_.emplace(frame.size);
        pcf_->render(frame, images_->sharp);
        blur(frame, images_->sharp, {1, 0}, images_->alongRows);
        blur(frame, images_->alongRows, {0, 1}, visibility);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return pcf_->mapPoint(world);
    }

private:
    struct Images {
        explicit Images(glm::ivec2 size) : sharp(gl::Format::R32F, size), alongRows(gl::Format::R32F, size) {}
        gl::Texture sharp, alongRows;
    };

    void blur(const Frame& frame, const gl::Texture& from, glm::vec2 axis, const gl::Texture& to) {
        gaussian_.set("image", from).set("axis", axis).set("pairs", pairs_);
        resolve(frame, {&to}, gaussian_, "blur");
    }

    std::unique_ptr<Technique> pcf_;
    std::vector<glm::vec2> pairs_;
    gl::Program gaussian_;
    std::optional<Images> images_;
};

} // namespace

Entry pcfBlur() {
    std::vector<Parameter> parameters{
        // 15 taps of a pixel each cover three deviations to either side.
        {"sigma", "2.5", RealRange{0.5, 5}, "standard deviation of the Gaussian, in pixels", "Zápotocký 5.2 (15 taps)"}};
    for (Parameter& parameter : pcfParameters()) parameters.push_back(std::move(parameter));
    return {.id = "pcf-blur",
            .title = "Percentage-closer filtering, blurred in the image",
            .source = {Document::Zapotocky, "3.3"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PcfBlur>(p); }};
}

} // namespace shadowbench::techniques
