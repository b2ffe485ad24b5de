#include "groundtruth/oracle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "embedded_oracle_sources.h"
#include "groundtruth/certify/agreement.h"
#include "groundtruth/certify/certificate.h"
#include "groundtruth/certify/pixel_certificate.h"
#include "groundtruth/cgal/area/area.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/plan/plan_view.h"
#include "groundtruth/povray/povray.h"
#include "groundtruth/povray/uncertainty.h"
#include "groundtruth/reference_parts.h"
#include "groundtruth/sky_reference.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace shadowbench::groundtruth {
namespace {

constexpr int referenceCodeVersion =
    2; // of this file, the uncertainty and the certificate: raise it with every change that can alter a number

constexpr int pixelAreaCodeVersion = 2; // of groundtruth/cgal/hard/pixel_*.cpp and the certificate of pixel areas

/// A light moved by more than its own size is far above this; an occluder too thin for the samples stays below.
constexpr double mostLightMismatch = 0.01;

void requireAnswerable(const Request& request) {
    if (request.size.x < 1 || request.size.y < 1)
        throw BadInput(fmt::format("a reference of {} × {} pixels has none: give a size of at least 1 × 1", request.size.x,
                                   request.size.y));
    requireTruth("the snapshot", request.snapshot.light, request.truth);
}

/// Exact labels for the light's centre against pixels that POV-Ray sees as fully lit or fully shadowed.
double lightMismatch(const Request& request, const Triangles& triangles, const PrimaryHits& primary,
                     const Image<float>& visible, const Progress& progress) {
    Snapshot centre = request.snapshot;
    centre.light = centre.light.centreOnly();
    Reference exact = unlabelled(primary);
    hard::ExactScene(centre, triangles, availableThreads()).labelByRays(request.size, primary, exact, progress);

    std::size_t differing = 0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const bool resolved = visible[i] == 0 || visible[i] == 1;
        if (resolved && exact.surface[i] == Surface::Receiver && exact.visibility[i] != visible[i]) ++differing;
    }
    return static_cast<double>(differing) / static_cast<double>(visible.size());
}

void requireAligned(const Request& request, const povray::Render& image, const std::map<std::string, double>& measured) {
    requireSamePrimaryHits(request, image, measured.at("primary_mismatch"));
    if (const double share = measured.at("light_mismatch"); share > mostLightMismatch)
        throw InternalError(fmt::format("POV-Ray and the exact hard shadow of the light's centre contradict each other on "
                                        "{:.2f} % of the pixels (at most {:.0f} %): occluders too thin for {} samples, or "
                                        "misaligned lights; ask for more samples",
                                        100 * share, 100 * mostLightMismatch, request.samples));
}

Reference softReference(const Request& request, const Progress& progress) {
    const auto triangles = std::make_shared<const geometry::SceneTriangles>(request.snapshot);
    const PrimaryHits primary =
        hard::ExactScene(request.snapshot, triangles, availableThreads()).primaryHits(request.size, part(progress, 0, 0.05));
    const povray::Render image = povray::render(request.snapshot, request.size, request.samples,
                                                {.threads = availableThreads()}, part(progress, 0.05, 0.85));

    Reference reference = unlabelled(primary);
    reference.provenance.oracle = "povray";
    reference.provenance.samples = request.samples;
    reference.provenance.measured = {
        {"primary_mismatch", primaryMismatch(image, primary)},
        {"light_mismatch", lightMismatch(request, triangles, primary, image.visible, part(progress, 0.85, 0.9))},
        {"scale", image.scale}};
    requireAligned(request, image, reference.provenance.measured);

    const area::AreaScene scene(request.snapshot, triangles, availableThreads());
    const Certificate certificate =
        certify(scene, request, image, primary, certificatePointCount, availableThreads(), part(progress, 0.9, 1));
    requireCertified(certificate, request.samples);
    reference.provenance.measured.merge(measured(certificate));

    const Image<float> sigma =
        calibrated(povray::samplingUncertainty(image, primary.id, request.samples), certificate, request.samples);
    fillReceivers(image.visible, sigma, reference);
    return reference;
}

area::Share shareOf(Truth truth) {
    if (truth == Truth::Irradiance) return area::Share::Irradiance;
    return truth == Truth::SolidAngle ? area::Share::SolidAngle : area::Share::Area;
}

bool isExactShare(Truth truth) { return truth == Truth::Area || truth == Truth::Irradiance || truth == Truth::SolidAngle; }

/// The exact visible share at every pixel.
Reference areaReference(const Request& request, const Progress& progress) {
    const auto triangles = std::make_shared<const geometry::SceneTriangles>(request.snapshot);
    const PrimaryHits primary =
        hard::ExactScene(request.snapshot, triangles, availableThreads()).primaryHits(request.size, part(progress, 0, 0.05));
    Reference reference = unlabelled(primary);
    area::AreaScene(request.snapshot, triangles, availableThreads())
        .label(request.size, primary, reference, part(progress, 0.05, 1), shareOf(request.truth));
    reference.provenance.oracle = name(request.truth);
    return reference;
}

/// 1 at the receiver pixels that one of `planes` holds.
Image<std::uint8_t> onPlanes(const PrimaryHits& primary, const std::vector<hard::PlanarReceiver>& planes) {
    Image<std::uint8_t> result(primary.id.width(), primary.id.height());
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (primary.surface[i] != Surface::Receiver) continue;
        const bool held = std::ranges::any_of(planes, [&](const hard::PlanarReceiver& plane) {
            return plane.id == primary.id[i] && std::ranges::binary_search(plane.triangles, primary.triangle[i]);
        });
        result[i] = held ? 1 : 0;
    }
    return result;
}

Reference byRays(const Request& request, const hard::ExactScene& scene, const PrimaryHits& primary,
                 const Progress& progress) {
    Reference reference = unlabelled(primary);
    scene.labelByRays(request.size, primary, reference, progress);
    reference.provenance.oracle = "rays";
    return reference;
}

/// Receivers off every plane have no label.
Reference withoutLabels(const PrimaryHits& primary, const std::vector<hard::PlanarReceiver>& planes) {
    Reference reference = unlabelled(primary);
    const Image<std::uint8_t> held = onPlanes(primary, planes);
    for (std::size_t i = 0; i < held.size(); ++i)
        if (primary.surface[i] == Surface::Receiver && held[i] == 0) reference.surface[i] = Surface::OnEdge;
    return reference;
}

Reference byPlan(const Request& request, const PrimaryHits& primary, const std::vector<hard::PlanarReceiver>& planes) {
    const std::vector<hard::PlanarReceiver> floors = plan::planReceivers(request.snapshot, planes);
    if (floors.empty())
        throw BadInput(
            "the plan oracle needs a horizontal receiver, and none of this scene's covers enough of the image: use "
            "polygon or rays");
    Reference reference = withoutLabels(primary, floors);
    for (const hard::PlanarReceiver& floor : floors)
        plan::labelByPlan(request.snapshot, request.size, primary, floor, reference);
    reference.provenance.oracle = "plan";
    return reference;
}

Reference hardReference(const Request& request, const Progress& progress) {
    const hard::ExactScene scene(request.snapshot, availableThreads());
    const PrimaryHits primary = scene.primaryHits(request.size, part(progress, 0, 0.3));
    if (request.oracle == Oracle::Rays) return byRays(request, scene, primary, part(progress, 0.3, 1));

    const std::vector<hard::PlanarReceiver> planes = scene.planarReceivers(primary);
    if (request.oracle == Oracle::Plan) return byPlan(request, primary, planes);
    const bool polygonOnly = request.oracle == Oracle::Polygon;
    if (planes.empty() && polygonOnly)
        throw BadInput(
            "the polygon oracle needs a planar receiver, and none of this scene's covers enough of the image: use rays");

    Reference reference =
        polygonOnly ? withoutLabels(primary, planes) : byRays(request, scene, primary, part(progress, 0.3, 0.6));
    const Reference rays = reference;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double step = 0.4 / static_cast<double>(planes.size());
        const double from = 0.6 + step * static_cast<double>(i);
        scene.labelByPolygon(request.size, primary, planes[i], reference, part(progress, from, from + step));
    }
    reference.provenance.oracle = "polygon";
    const Image<std::uint8_t> held = onPlanes(primary, planes);
    if (!polygonOnly) requireSameLabels(rays, reference, held);
    const auto receivers = std::ranges::count(primary.surface, Surface::Receiver);
    const bool all = polygonOnly || (!planes.empty() && std::ranges::count(held, 1) == receivers);
    reference.provenance.oracle = all ? "polygon" : planes.empty() ? "rays" : "polygon+rays";
    return reference;
}

/// C*: the mean of exact visibility over each pixel's square.
Reference pixelAreaReference(const Request& request, const Progress& progress) {
    const hard::ExactScene scene(request.snapshot, availableThreads());
    const PrimaryHits primary = scene.primaryHits(request.size, part(progress, 0, 0.1));
    const Reference labels = byRays(request, scene, primary, part(progress, 0.1, 0.3));
    Reference reference = labels;
    scene.averageOverPixels(request.size, primary, reference, part(progress, 0.3, 0.8));
    const PixelCertificate certificate =
        certifyPixels(scene, reference, labels, pixelCertificatePoints, availableThreads(), part(progress, 0.8, 1));
    requirePixelsCertified(certificate);
    reference.provenance.oracle = "pixel-areas";
    reference.provenance.measured = measured(certificate);
    return reference;
}

Reference answer(const Request& request, const Progress& progress) {
    switch (request.truth) {
    case Truth::Hard:
        return hardReference(request, progress);
    case Truth::PixelArea:
        return pixelAreaReference(request, progress);
    case Truth::Soft:
        return request.snapshot.light.isArea() ? softReference(request, progress) : skyReference(request, progress);
    case Truth::Area:
    case Truth::Irradiance:
    case Truth::SolidAngle:
        break;
    }
    return areaReference(request, progress);
}

Reference computeWith(const ReferenceKey& key, const Request& request, const Progress& progress) {
    requireAnswerable(request);
    const auto start = std::chrono::steady_clock::now();
    Request lit = request;
    lit.snapshot.light = request.light();
    Reference reference = answer(lit, progress);
    reference.provenance.key = key.text;
    reference.provenance.tools = key.tools;
    reference.provenance.sources = key.sources;
    reference.provenance.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return reference;
}

} // namespace

Tools toolVersions(const Request& request) {
    Tools tools = hard::toolVersions();
    tools["reference"] = std::to_string(referenceCodeVersion);
    if (request.truth == Truth::PixelArea) tools["pixel areas"] = std::to_string(pixelAreaCodeVersion);
    if (request.truth == Truth::Hard && request.oracle == Oracle::Plan) tools["plan"] = std::to_string(plan::codeVersion);
    const bool sampled = request.truth == Truth::Soft, ofArea = request.light().isArea();
    if (ofArea) tools["area"] = std::to_string(area::codeVersion);
    if (shareOf(request.truth) != area::Share::Area) tools["area weights"] = std::to_string(area::weightsCodeVersion);
    if (sampled && ofArea) tools["certificate"] = std::to_string(certificateVersion);
    if (sampled && !ofArea) tools["povray sky"] = std::to_string(povray::skyCodeVersion);
    if (sampled) tools["povray"] = povray::version();
    if (sampled) tools["povray recipe"] = std::to_string(povray::codeVersion);
    return tools;
}

std::string sourcesOf(const Request& request) {
    if (isExactShare(request.truth)) return embedded::area_sources;
    if (request.truth == Truth::Soft) return embedded::sampled_sources;
    return request.truth == Truth::Hard && request.oracle == Oracle::Plan ? embedded::plan_sources : embedded::exact_sources;
}

std::set<std::string> allSources() {
    return {embedded::exact_sources, embedded::plan_sources, embedded::area_sources, embedded::sampled_sources};
}

Reference compute(const Request& request, const Progress& progress) {
    requireAnswerable(request); // a wrong request is reported rather than a missing tool
    return computeWith(referenceKey(request), request, progress);
}

ReferenceKey referenceKey(const Request& request) {
    Tools tools = toolVersions(request);
    std::string text = key(request, tools);
    return {std::move(text), std::move(tools), sourcesOf(request)};
}

std::string key(const Request& request) { return referenceKey(request).text; }

Reference cached(const Cache& cache, const Request& request, const Progress& progress) {
    return cached(cache, request, referenceKey(request), progress);
}

Reference cached(const Cache& cache, const Request& request, const ReferenceKey& key, const Progress& progress) {
    return cache.get(
        key.text, key.sources, [&] { return computeWith(key, request, progress); }, progress);
}

} // namespace shadowbench::groundtruth
