// Precomputed radiance transfer in Haar wavelets (Ng, Ramamoorthi, Hanrahan 2003; course, "PRT with Haar Wavelets"): like
// prt-sh, but light and transfer are the wavelet coefficients of cube maps. All coefficients of every point's transfer are
// kept; a light's n largest decide which of them are used.
// Departures: those of prt-sh; the kept transfer is not compressed; the dot products run on the GPU, which the course
// advises against, since the n chosen coefficients of all vectors are uploaded when the light changes.
#include "techniques/contract/entry.h"
#include "techniques/environment/cube_light.h"
#include "techniques/environment/haar.h"
#include "techniques/environment/light_change.h"
#include "techniques/environment/point_shading.h"
#include "techniques/environment/prt-haar/haar_transfer.h"
#include "techniques/environment/static_scene.h"

namespace shadowbench::techniques {
namespace {

class PrtHaar final : public Technique {
public:
    explicit PrtHaar(const Parameters& p)
        : budget_(static_cast<std::size_t>(p.integer("points"))), n_(static_cast<std::size_t>(p.integer("n"))),
          side_(std::stoi(p.text("resolution"))), directions_(cubeSamples(side_, p.integer("rays"))) {}

    void reset() override { shading_.forget(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!shading_.isOf(frame.snapshot)) precompute(frame);
        if (light_.changesTo(frame.snapshot.light)) projectLight(frame);
        computeIrradiance(frame);
        shading_.lookUp(frame, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"points", static_cast<double>(shading_.points().points.size())},
                {"spacing", shading_.points().spacing},
                {"transfer_bytes", static_cast<double>(transfer_.size() * sizeof(float))},
                {"coefficients", static_cast<double>(used_)},
                {"rays", static_cast<double>(shading_.points().points.size() * directions_.size())}};
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        return shading_.bare(frame, shading_.vectors() * used_);
    }

private:
    void precompute(const Frame& frame) {
        const auto pass = frame.pass("precomputation");
        shading_.begin(frame.snapshot, budget_);
        transfer_ = haarTransfer(shading_.points(), frame.snapshot, directions_, side_);
        light_.forget();
    }

    /// The light's largest coefficients, and the same of all transfer vectors.
    void projectLight(const Frame& frame) {
        const auto pass = frame.pass("light projection");
        std::vector<double> light = cubeLight(*frame.snapshot.light.environment, side_);
        haarTransform(light, side_);
        const std::vector<std::size_t> chosen = largestCoefficients(light, side_, n_);
        used_ = chosen.size();
        std::vector<float> coefficients;
        for (const std::size_t i : chosen) coefficients.push_back(static_cast<float>(light[i]));
        lightCoefficients_.upload(coefficients.data(), coefficients.size() * sizeof(float));
        const std::vector<float> transfer = chosenCoefficients(transfer_, cubeTexels(side_), chosen);
        chosenTransfer_.upload(transfer.data(), transfer.size() * sizeof(float));
    }

    void computeIrradiance(const Frame& frame) {
        const auto pass = frame.pass("dot products");
        shading_.setDotProducts(chosenTransfer_, shading_.vectors(), lightCoefficients_, used_);
    }

    std::size_t budget_, n_;
    int side_;
    std::vector<DirectionSample> directions_;
    PointShading shading_;
    LightChange light_;
    std::vector<float> transfer_; // all coefficients
    std::size_t used_ = 0;
    gl::Buffer chosenTransfer_, lightCoefficients_;
};

} // namespace

Entry prtHaar() {
    return {
        .id = "prt-haar",
        .title = "Precomputed radiance transfer, Haar wavelets",
        .source = {Document::Course, "PRT with Haar Wavelets"},
        .answer = Answer::Soft,
        .environment = EnvironmentAnswer::Only,
        .notApplicable = movingSurfaces,
        .parameters = {{"n", "100", IntegerRange{1, 24576}, "coefficients of the light that are used: its largest",
                        "course, PRT with Haar Wavelets"},
                       {"resolution", "16", OneOf{{"16", "32", "64"}}, "texels along a side of the cube map's faces",
                        "course, PRT with Haar Wavelets"},
                       {"points", "8192", IntegerRange{64, 1048576},
                        "with a transfer vector on the surfaces, at most, beside one a triangle smaller than their spacing",
                        ""},
                       {"rays", "2", IntegerRange{1, 8}, "from each point through each texel, squared", ""}},
        .figures = {{"points", "points of the surfaces with a transfer vector"},
                    {"spacing", "of the points, metres at most"},
                    {"transfer_bytes", "of transfer that is kept: all coefficients of points and triangles"},
                    {"coefficients", "of the light that are used"},
                    {"rays", "of the precomputation, which is in the cost of the first frame alone"}},
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<PrtHaar>(p); }};
}

} // namespace shadowbench::techniques
