// Precomputed radiance transfer in Haar wavelets (Ng, Ramamoorthi, Hanrahan 2003; course, "PRT with Haar Wavelets"): like
// prt-sh, but light and transfer are the wavelet coefficients of cube maps. All coefficients of every point's transfer are
// computed; a light's n largest decide which of them are used.
// Departures: those of prt-sh; of the transfer, coefficients below a threshold are not stored, the simplest of the
// compressions that the course asks for; the dot products run on the GPU, which the course advises against, since the n
// chosen coefficients of all vectors are uploaded when the light changes; E₀, which is the light's alone, is then summed
// over the texels of what the n coefficients hold, so that no transfer without shadows is stored.
#include "techniques/contract/entry.h"
#include "techniques/environment/cube_light.h"
#include "techniques/environment/haar.h"
#include "techniques/environment/light_change.h"
#include "techniques/environment/point_shading.h"
#include "techniques/environment/prt-haar/haar_transfer.h"
#include "techniques/environment/transfer_entry.h"

namespace shadowbench::techniques {
namespace {

class PrtHaar final : public Technique {
public:
    explicit PrtHaar(const Parameters& p)
        : budget_(static_cast<std::size_t>(p.integer("points"))), n_(static_cast<std::size_t>(p.integer("n"))),
          side_(std::stoi(p.text("resolution"))), least_(p.real("threshold")),
          directions_(cubeSamples(side_, p.integer("rays"))) {}

    void reset() override { shading_.forget(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!shading_.isOf(frame.snapshot)) precompute(frame);
        if (light_.changesTo(frame.snapshot.light)) projectLight(frame);
        computeIrradiance(frame);
        shading_.lookUp(frame, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        std::size_t bytes = 0;
        for (const StoredTransfer& vector : transfer_) bytes += vector.bytes();
        return withTransferFigures(
            {{"transfer_bytes", static_cast<double>(bytes)}, {"coefficients", static_cast<double>(used_)}},
            shading_.points(), directions_.size());
    }

private:
    void precompute(const Frame& frame) {
        const auto pass = frame.pass("precomputation");
        shading_.begin(frame.snapshot, budget_);
        transfer_ = haarTransfer(shading_.points(), frame.snapshot, directions_, side_, least_);
        light_.forget();
    }

    /// The light's largest coefficients, the same of all transfer vectors, and E₀ of the light that they hold.
    void projectLight(const Frame& frame) {
        const auto pass = frame.pass("light projection");
        std::vector<double> light = cubeLight(*frame.snapshot.light.environment, side_);
        haarTransform(light, side_);
        const std::vector<std::size_t> chosen = largestCoefficients(light, side_, n_);
        used_ = chosen.size();
        std::vector<float> coefficients;
        std::vector<double> held(light.size());
        for (const std::size_t i : chosen) {
            coefficients.push_back(static_cast<float>(light[i]));
            held[i] = light[i];
        }
        inverseHaarTransform(held, side_);
        upload(lightCoefficients_, coefficients);
        upload(chosenTransfer_, chosenCoefficients(transfer_, chosen));
        upload(shading_.unshadowed(), unshadowedIrradiance(shading_.points().patches, directions_, held));
    }

    static void upload(gl::Buffer& buffer, const std::vector<float>& values) {
        buffer.upload(values.data(), values.size() * sizeof(float));
    }

    void computeIrradiance(const Frame& frame) {
        const auto pass = frame.pass("dot products");
        shading_.setDotProducts(shading_.irradiance(), shading_.pointCount(), chosenTransfer_, lightCoefficients_, used_);
    }

    std::size_t budget_, n_;
    int side_;
    double least_; // coefficient that is stored
    std::vector<DirectionSample> directions_;
    PointShading shading_;
    LightChange light_;
    std::vector<StoredTransfer> transfer_;
    std::size_t used_ = 0;
    gl::Buffer chosenTransfer_, lightCoefficients_;
};

} // namespace

Entry prtHaar() {
    return {.id = "prt-haar",
            .title = "Precomputed radiance transfer, Haar wavelets",
            .source = {Document::Course, "PRT with Haar Wavelets"},
            .answer = Answer::Soft,
            .computed = "once for a scene, rays and all coefficients of transfer; when the light changes, its largest "
                        "coefficients, the same of all points, and the irradiance without shadows; each frame, dot products "
                        "and interpolation",
            .environment = EnvironmentAnswer::Only,
            .notApplicable = movingSurfaces,
            .parameters = withPoints(
                {{"n", "100", IntegerRange{1, 24576}, "coefficients of the light that are used: its largest",
                  "course, PRT with Haar Wavelets"},
                 {"resolution", "64", OneOf{{"16", "32", "64"}}, "texels along a side of the cube map's faces",
                  "course, PRT with Haar Wavelets"},
                 {"rays", "1", IntegerRange{1, 8}, "from each point through each texel, squared", ""},
                 {"threshold", "5e-5", RealRange{0, 1},
                  "least coefficient of transfer that is stored, where the irradiance of a sky of radiance 1 is π", ""}},
                32768),
            .figures = withTransferFigures({{"transfer_bytes", "of transfer that is kept: the coefficients of all points"},
                                            {"coefficients", "of the light that are used"}}),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PrtHaar>(p); }};
}

} // namespace shadowbench::techniques
