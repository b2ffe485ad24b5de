#include "groundtruth/sky_reference.h"

#include "base/parallel.h"
#include "groundtruth/certify/sky_certificate.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/povray/uncertainty.h"
#include "groundtruth/reference_parts.h"

namespace shadowbench::groundtruth {
namespace {

/// Of the largest E₀ in the image: below it the 16 bits of a channel leave too few steps between nothing and all.
constexpr double dimmest = 1.0 / 256;

/// What no light reaches, whatever stands there, is not scored.
void leaveOutUnlit(const Image<double>& unoccluded, Image<Surface>& surface) {
    for (std::size_t i = 0; i < surface.size(); ++i)
        if (surface[i] == Surface::Receiver && unoccluded[i] < dimmest) surface[i] = Surface::FacesAway;
}

} // namespace

MeasuredSky measuredSky(const Request& request, int points, const povray::SkyRecipe& recipe, const Progress& progress) {
    const int threads = availableThreads();
    const auto triangles = std::make_shared<const geometry::SceneTriangles>(request.snapshot);
    PrimaryHits primary =
        hard::ExactScene(request.snapshot, triangles, threads).primaryHits(request.size, part(progress, 0, 0.02));
    const povray::SkyRender render =
        povray::renderSky(request.snapshot, request.samples, hard::seenNormals(request.snapshot, *triangles, primary),
                          {.threads = threads}, recipe, part(progress, 0.02, 0.5));
    leaveOutUnlit(render.unoccluded, primary.surface);

    MeasuredSky result{unlabelled(primary), {}};
    Provenance& provenance = result.reference.provenance;
    provenance.oracle = "povray";
    provenance.samples = request.samples;
    provenance.measured = {{"primary_mismatch", primaryMismatch(render.image, primary)}, {"scale", render.image.scale}};
    requireSamePrimaryHits(request, render.image, provenance.measured.at("primary_mismatch"));

    const hard::ExactSky scene(request.snapshot, triangles);
    result.certificate = certifySky(scene, *request.snapshot.light.environment, render.image, primary, request.samples,
                                    points, threads, part(progress, 0.5, 1));
    provenance.measured.merge(measured(result.certificate));
    provenance.measured["certificate_directions"] = certificateDirections;
    const Image<float> sigma = calibrated(povray::samplingUncertainty(render.image, primary.id, request.samples),
                                          result.certificate, request.samples);
    fillReceivers(render.image.visible, sigma, result.reference);
    return result;
}

Reference skyReference(const Request& request, const Progress& progress) {
    MeasuredSky result = measuredSky(request, skyCertificatePointCount, {}, progress);
    requireSkyCertified(result.certificate, request.samples);
    return std::move(result.reference);
}

} // namespace shadowbench::groundtruth
