// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel, Kautz 2007; Scherzer 2.2.1): the shadow test as a function of
// occluder and receiver depth is a step, and a step is a Fourier series, each of whose terms is a product of a factor of the
// receiver and one of the occluder: ½ + 2 Σ 1/c_k (cos(c_k d) sin(c_k z) − sin(c_k d) cos(c_k z)), c_k = π (2k − 1). Sines
// and cosines of the occluder's depth are stored, 8 bits each as in the paper, and filtered; the test is linear in them, so
// that several occluders do not leak as under a variance shadow map. Few terms are the known failure: the step has a width
// of about 1/M of the depth range, within which an occluder is transparent, and rings beside it (Gibbs); the paper's damping
// of high frequencies trades one for the other. Departures: the offset that lifts surfaces off their own half-lit step is
// given in units of half the shortest wave, and the gain that it needs is computed; a smaller offset hides less of the
// shadow where things touch and needs more gain, which narrows penumbrae and magnifies 8-bit rounding: the default is about
// the least whose lit surfaces no rounding darkens; depths use a little less than the wave's half period; sines and cosines
// are rounded to 8 bits as means, not before; for the rest (footprint, box, linear depth) see vsm.cpp.
#include "techniques/filtered/csm-fourier/csm-fourier.h"

#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/prefiltered_map.h"
#include "techniques/gl/counters.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <string>

namespace shadowbench::techniques {

double fourierFrequency(int k) { return glm::pi<double>() * (2 * k - 1); }

double fourierDamping(int k, int terms, double damping) {
    const double share = static_cast<double>(k) / terms;
    return std::exp(-damping * share * share);
}

double fourierStep(double x, int terms, double damping) {
    double sum = 0.5;
    for (int k = 1; k <= terms; ++k)
        sum += fourierDamping(k, terms, damping) * 2 / fourierFrequency(k) * std::sin(fourierFrequency(k) * x);
    return sum;
}

double usedDepth(int terms) { return 1 - 1.0 / terms; }

double litGain(int terms, double damping, double offset) {
    constexpr double room = 1.03; // rounding to 8 bits moves the sum of the terms by less
    return std::max(1.0, room / fourierStep(offset, terms, damping));
}

namespace {

class CsmFourier final : public Technique {
public:
    explicit CsmFourier(const Parameters& p)
        : terms_(p.integer("terms")), damping_(p.real("damping")), offset_(0.5 * p.real("offset") / terms_),
          map_(p, {"filtered/csm-fourier/waves.comp", {}, gl::Format::RGBA8, terms_ / 2}), resolve_(program({})) {
        map_.basis().set("usedDepth", static_cast<float>(usedDepth(terms_)));
        resolve_.set("gain", static_cast<float>(litGain(terms_, damping_, offset_)));
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        map_.draw(frame);
        map_.bindTo(resolve_, frame);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return map_.pointAt(world); }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        gl::Program series = program({{"SERIES", "1"}});
        map_.bindTo(series, frame);
        const gl::Texture sums(gl::Format::R32F, frame.size);
        const gl::RenderTarget target{&sums};
        target.clearColour(0, glm::vec4(0.5F)); // neither above 1 nor below 0
        target.bind();
        gl::FragmentMeter meter;
        series.drawScreen();
        const std::uint64_t pixels = meter.finish();
        if (pixels == 0) return {};

        double greatest = 0, squares = 0;
        for (const float sum : target.readFloat(0)) {
            const double excess = std::max({static_cast<double>(sum) - 1, -static_cast<double>(sum), 0.0});
            greatest = std::max(greatest, excess);
            squares += excess * excess;
        }
        return {{"overshoot", greatest}, {"ringing", std::sqrt(squares / static_cast<double>(pixels))}};
    }

private:
    [[nodiscard]] gl::Program program(gl::Defines defines) const {
        defines.emplace_back("TERMS", std::to_string(terms_));
        gl::Program program = gl::Program::screen("filtered/csm-fourier/csm-fourier.frag", defines);
        program.set("usedDepth", static_cast<float>(usedDepth(terms_)))
            .set("offset", static_cast<float>(offset_))
            .set("damping", static_cast<float>(damping_));
        return program;
    }

    int terms_;
    double damping_, offset_;
    PrefilteredMap map_;
    gl::Program resolve_;
};

} // namespace

Entry csmFourier() {
    std::vector<Parameter> parameters = prefilteredMapParameters();
    parameters.push_back(
        {"terms", "16", OneOf{{"2", "4", "8", "16", "32"}}, "M, of the Fourier series", "dissertation 2.2.1"});
    parameters.push_back(
        {"damping", "1", RealRange{0, 8}, "of high frequencies: term k weighs exp(-damping (k/M)^2)", "Annen et al. 2007"});
    parameters.push_back(
        {"offset", "0.5", RealRange{0.25, 1}, "of receivers towards the light, in 1/(2M) of the depth range", ""});
    return {.id = "csm-fourier",
            .title = "Convolution shadow map",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .figures = {{"overshoot", "largest excess of the Fourier sum above 1 or below 0 in the image (1 = full light)"},
                        {"ringing", "root mean square of that excess over the pixels that the map holds"}},
            .variants = {"", "kernel=3"},
            .make = [](const Parameters& p) { return std::make_unique<CsmFourier>(p); }};
}

} // namespace shadowbench::techniques
