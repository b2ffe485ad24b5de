#include "groundtruth/certify/agreement.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/plan/plan_view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace shadowbench::groundtruth {
namespace {

/// One comparison; nothing if it does not apply to the request.
using Comparison = std::optional<Agreement> (*)(const Request&, const Progress&);

template <typename Work>
double secondsOf(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A reference in which no pixel has a label yet: its visibility is −1.
Reference unlabelled(const PrimaryHits& primary) {
    const int width = primary.id.width(), height = primary.id.height();
    Reference reference;
    reference.visibility = Image<float>(width, height, -1);
    reference.sigma = Image<float>(width, height);
    reference.edgeDistance = Image<float>(width, height, std::numeric_limits<float>::infinity());
    reference.surface = primary.surface;
    reference.id = primary.id;
    reference.position = primary.position;
    return reference;
}

Image<std::uint8_t> labelled(const Reference& reference) {
    Image<std::uint8_t> result(reference.surface.width(), reference.surface.height());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = reference.surface[i] == Surface::OnEdge || reference.visibility[i] >= 0;
    return result;
}

std::optional<Agreement> polygonAndRays(const Request& request, const Progress& progress) {
    if (request.snapshot.light.isArea() || request.snapshot.light.isEnvironment()) return std::nullopt;
    const hard::ExactScene scene(request.snapshot, availableThreads());
    PrimaryHits primary = scene.primaryHits(request.size, progress);
    const std::vector<hard::PlanarReceiver> planes = scene.planarReceivers(primary);
    if (planes.empty()) return std::nullopt;

    Agreement agreement;
    agreement.a = "polygon";
    agreement.b = "rays";
    agreement.pixelsCompared = "planar receivers";
    Reference byPolygon = unlabelled(primary), byRays;
    agreement.secondsA = secondsOf([&] {
        for (const hard::PlanarReceiver& plane : planes)
            scene.labelByPolygon(request.size, primary, plane, byPolygon, progress);
    });
    const Image<std::uint8_t> compared = labelled(byPolygon);
    for (std::size_t i = 0; i < compared.size(); ++i) // so that both work on the same pixels
        if (primary.surface[i] == Surface::Receiver && compared[i] == 0) primary.surface[i] = Surface::FacesAway;
    agreement.secondsB = secondsOf([&] { scene.labelByRays(request.size, primary, byRays, progress); });
    countLabels(byPolygon, byRays, compared, agreement);
    return agreement;
}

/// Plan-view scenes only.
std::optional<Agreement> planAndPolygon(const Request& request, const Progress& progress) {
    if (request.snapshot.light.kind != LightKind::Point) return std::nullopt;
    const hard::ExactScene scene(request.snapshot, availableThreads());
    const PrimaryHits primary = scene.primaryHits(request.size, progress);
    const std::vector<hard::PlanarReceiver> floors = plan::planReceivers(request.snapshot, scene.planarReceivers(primary));
    if (floors.empty()) return std::nullopt;

    Agreement agreement;
    agreement.a = "plan";
    agreement.b = "polygon";
    agreement.pixelsCompared = "horizontal receivers";
    Reference byPlan = unlabelled(primary), byPolygon = unlabelled(primary);
    try {
        agreement.secondsA = secondsOf([&] {
            for (const hard::PlanarReceiver& floor : floors)
                plan::labelByPlan(request.snapshot, request.size, primary, floor, byPlan);
        });
    } catch (const BadInput&) { // no plan view
        return std::nullopt;
    }
    agreement.secondsB = secondsOf([&] {
        for (const hard::PlanarReceiver& floor : floors)
            scene.labelByPolygon(request.size, primary, floor, byPolygon, progress);
    });
    countLabels(byPlan, byPolygon, labelled(byPlan), agreement);
    return agreement;
}

constexpr std::array<Comparison, 2> comparisons{polygonAndRays, planAndPolygon};

} // namespace

void countLabels(const Reference& a, const Reference& b, const Image<std::uint8_t>& compared, Agreement& agreement) {
    for (std::size_t i = 0; i < compared.size(); ++i) {
        if (compared[i] == 0) continue;
        ++agreement.pixels;
        const bool onA = a.surface[i] == Surface::OnEdge, onB = b.surface[i] == Surface::OnEdge;
        agreement.onEdge += onA && onB;
        agreement.onOneEdge += onA != onB;
        agreement.differing += !onA && !onB && a.visibility[i] != b.visibility[i];
    }
}

void requireSameLabels(const Reference& a, const Reference& b, const Image<std::uint8_t>& compared) {
    for (int y = 0; y < compared.height(); ++y) {
        for (int x = 0; x < compared.width(); ++x) {
            const bool edge = a.surface(x, y) == Surface::OnEdge || b.surface(x, y) == Surface::OnEdge;
            if (compared(x, y) == 0 || edge || a.visibility(x, y) == b.visibility(x, y)) continue;
            throw Inconclusive(fmt::format("two exact oracles contradict each other at pixel ({}, {}): {} says {}, {} says "
                                           "{}; one of them is wrong, so there is no truth: report this scene",
                                           x, y, a.provenance.oracle, a.visibility(x, y) > 0 ? "lit" : "shadowed",
                                           b.provenance.oracle, b.visibility(x, y) > 0 ? "lit" : "shadowed"));
        }
    }
}

std::vector<Agreement> oracleAgreement(const Request& request, const Progress& progress) {
    std::vector<Agreement> result;
    for (const Comparison compare : comparisons)
        if (std::optional<Agreement> agreement = compare(request, progress)) result.push_back(std::move(*agreement));
    return result;
}

} // namespace shadowbench::groundtruth
