// Precomputed radiance transfer in spherical harmonics (Sloan, Kautz, Snyder 2002; course, "Radiance Transfer"):
// 1. once, rays from points on all surfaces find each one's transfer T(s) = V(s) max(n · s, 0), which is projected onto the
//    basis; 2. the light is projected whenever it changes; 3. every frame, a dot product of the two is the irradiance E of
// each point. With compression=clustered, vectors are replaced by those of their cluster's principal components, whose few
// dot products the processor computes (course, "Reducing Storage Cost").
// Departures: visibility is E / E₀, with E₀ the dot product of the light and the transfer without V, so that the albedo and
// π cancel and the light's own cut-off after five bands does in part; the points lie in rows on the triangles
// (techniques/environment/surface_points.h), where the course has vertices or texels; directions are the points of a
// lattice, not random; no interreflection; clusters are those of plain vector quantisation.
#include "techniques/contract/entry.h"
#include "techniques/environment/harmonic_light.h"
#include "techniques/environment/light_change.h"
#include "techniques/environment/point_shading.h"
#include "techniques/environment/prt-sh/clustered_pca.h"
#include "techniques/environment/prt-sh/harmonic_transfer.h"
#include "techniques/environment/transfer_entry.h"

#include <numeric>
#include <optional>

namespace shadowbench::techniques {
namespace {

class PrtSh final : public Technique {
public:
    explicit PrtSh(const Parameters& p)
        : budget_(static_cast<std::size_t>(p.integer("points"))),
          coefficients_(static_cast<std::size_t>(std::stoi(p.text("coefficients")))),
          directions_(evenSamples(p.integer("directions"))), isCompressed_(p.text("compression") == "clustered"),
          clusters_(static_cast<std::size_t>(p.integer("clusters"))),
          components_(static_cast<std::size_t>(p.integer("components"))) {}

    void reset() override { shading_.forget(); }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!shading_.isOf(frame.snapshot)) precompute(frame);
        if (light_.changesTo(frame.snapshot.light)) projectLight(frame);
        computeIrradiance(frame);
        shading_.lookUp(frame, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        const std::size_t unshadowed = shading_.patchCount() * coefficients_ * sizeof(float);
        const std::size_t shadowed =
            compressed_ ? compressed_->bytes() : shading_.pointCount() * coefficients_ * sizeof(float);
        return withTransferFigures({{"transfer_bytes", static_cast<double>(unshadowed + shadowed)},
                                    {"compression_error", compressed_ ? compressed_->rmsError : 0}},
                                   shading_.points(), directions_.size());
    }

private:
    void precompute(const Frame& frame) {
        const auto pass = frame.pass("precomputation");
        shading_.begin(frame.snapshot, budget_);
        const std::vector<float> vectors = harmonicTransfer(shading_.points(), frame.snapshot, directions_, coefficients_);
        uploadTransfer(vectors);
        light_.forget();
    }

    /// Splits the vectors into those of the points, which may be compressed, and those of the patches.
    void uploadTransfer(std::span<const float> vectors) {
        const std::size_t ofPoints = shading_.pointCount() * coefficients_;
        uploadByCoefficient(vectors.subspan(ofPoints), unshadowed_);
        if (!isCompressed_) return uploadByCoefficient(vectors.first(ofPoints), transfer_);
        compressed_ = clusteredPca(vectors.first(ofPoints), coefficients_, clusters_, components_);
        clusterNumbers_.upload(compressed_->cluster.data(), compressed_->cluster.size() * sizeof(std::uint32_t));
        weights_.upload(compressed_->weights.data(), compressed_->weights.size() * sizeof(float));
    }

    void uploadByCoefficient(std::span<const float> vectors, gl::Buffer& buffer) const {
        const std::size_t count = vectors.size() / coefficients_;
        std::vector<float> turned(vectors.size());
        for (std::size_t i = 0; i < vectors.size(); ++i) turned[i % coefficients_ * count + i / coefficients_] = vectors[i];
        buffer.upload(turned.data(), turned.size() * sizeof(float));
    }

    void projectLight(const Frame& frame) {
        const auto pass = frame.pass("light projection");
        const ShVector light = harmonicLight(*frame.snapshot.light.environment);
        const std::vector<float> coefficients(light.begin(), light.begin() + static_cast<std::ptrdiff_t>(coefficients_));
        lightCoefficients_.upload(coefficients.data(), coefficients.size() * sizeof(float));
        if (compressed_) uploadResponses(coefficients);
    }

    /// Dot products of the light with the means and components of all clusters.
    void uploadResponses(const std::vector<float>& light) {
        std::vector<float> responses;
        for (std::size_t at = 0; at < compressed_->bases.size(); at += coefficients_)
            responses.push_back(std::inner_product(light.begin(), light.end(), &compressed_->bases[at], 0.0F));
        responses_.upload(responses.data(), responses.size() * sizeof(float));
    }

    void computeIrradiance(const Frame& frame) {
        const auto pass = frame.pass("dot products");
        const std::size_t points = shading_.pointCount();
        shading_.setDotProducts(shading_.unshadowed(), shading_.patchCount(), unshadowed_, lightCoefficients_,
                                coefficients_);
        if (!compressed_)
            return shading_.setDotProducts(shading_.irradiance(), points, transfer_, lightCoefficients_, coefficients_);
        clusterNumbers_.bindStorage(0);
        weights_.bindStorage(1);
        shading_.irradiance().bindStorage(2);
        responses_.bindStorage(3);
        weightedSum_.set("vectors", static_cast<int>(points)).set("components", static_cast<int>(compressed_->components));
        weightedSum_.dispatch(points);
    }

    std::size_t budget_, coefficients_;
    std::vector<DirectionSample> directions_;
    bool isCompressed_;
    std::size_t clusters_, components_;
    PointShading shading_;
    LightChange light_;
    std::optional<ClusteredVectors> compressed_;
    gl::Buffer transfer_, unshadowed_, lightCoefficients_;
    gl::Buffer clusterNumbers_, weights_, responses_;
    gl::Program weightedSum_ = gl::Program::compute("environment/prt-sh/weighted_sum.comp");
};

} // namespace

Entry prtSh() {
    return {
        .id = "prt-sh",
        .title = "Precomputed radiance transfer, spherical harmonics",
        .source = {Document::Course, "Radiance Transfer"},
        .answer = Answer::Soft,
        .computed = "once for a scene, rays and transfer vectors; when the light changes, its coefficients; each frame, dot "
                    "products and interpolation",
        .environment = EnvironmentAnswer::Only,
        .notApplicable = movingSurfaces,
        .parameters = withPoints(
            {{"coefficients", "25", OneOf{{"4", "9", "16", "25"}}, "basis functions: those of 2 to 5 bands",
              "course, Background – Spherical Harmonics"},
             {"directions", "1024", IntegerRange{64, 65536}, "of rays from each point, over the whole sphere", ""},
             {"compression", "none", OneOf{{"none", "clustered"}}, "of transfer vectors: VQ + PCA",
              "course, Reducing Storage Cost"},
             {"clusters", "64", IntegerRange{1, 4096}, "of transfer vectors, if compressed",
              "course, Compression – Comparison"},
             {"components", "3", IntegerRange{1, 25}, "principal components beside a cluster's mean, if compressed",
              "course, Compression – Comparison"}},
            16384),
        .figures =
            withTransferFigures({{"transfer_bytes", "of transfer that is kept, with the unshadowed one of each triangle"},
                                 {"compression_error", "root mean square of what compression changes of a coefficient"}}),
        .variants = {"", "compression=clustered"},
        .make = [](const Parameters& p) { return std::make_unique<PrtSh>(p); }};
}

} // namespace shadowbench::techniques
