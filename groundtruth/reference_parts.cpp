#include "groundtruth/reference_parts.h"

#include "base/error.h"
#include "groundtruth/cgal/hard/exact.h"

#include <fmt/format.h>
#include <limits>

namespace shadowbench::groundtruth {
namespace {

/// Two oracles that see the same geometry differ on isolated silhouette pixels only (docs/metrics.md, "Primary hits").
constexpr double mostPrimaryMismatch = 0.001;
constexpr std::size_t mostOnSilhouettes = 4; // in whatever image: 0.1 % of a tiny one is less than a pixel

bool differs(const povray::Render& image, const PrimaryHits& primary, int x, int y) {
    return (image.hit(x, y) != 0) != (primary.id(x, y) != 0);
}

/// Whether a neighbour has the exact hit or background that POV-Ray sees here.
bool liesOnSilhouette(const povray::Render& image, const PrimaryHits& primary, int x, int y) {
    for (int ny = y - 1; ny <= y + 1; ++ny)
        for (int nx = x - 1; nx <= x + 1; ++nx)
            if (primary.id.contains(nx, ny) && (primary.id(nx, ny) != 0) == (image.hit(x, y) != 0)) return true;
    return false;
}

/// Whether a few pixels differ, and those on silhouettes alone.
bool differOnSilhouettes(const povray::Render& image, const PrimaryHits& primary) {
    std::size_t differing = 0;
    for (int y = 0; y < primary.id.height(); ++y)
        for (int x = 0; x < primary.id.width(); ++x) {
            if (!differs(image, primary, x, y)) continue;
            if (++differing > mostOnSilhouettes || !liesOnSilhouette(image, primary, x, y)) return false;
        }
    return true;
}

/// POV-Ray has no near and no far plane. Throws BadInput if that explains the mismatch.
void requireUncutScene(const Request& request, const povray::Render& image) {
    Snapshot uncut = request.snapshot;
    uncut.camera.near *= 1e-6;
    uncut.camera.far *= 1e6;
    if (primaryMismatch(image, hard::primaryHits(uncut, request.size)) <= mostPrimaryMismatch)
        throw BadInput("the camera's near or far plane cuts through the scene, which the povray oracle cannot follow: "
                       "move the plane");
}

} // namespace

Progress part(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [&progress, from, to](double done, std::string_view what) { progress(from + (to - from) * done, what); };
}

Reference unlabelled(const PrimaryHits& primary) {
    const int width = primary.id.width(), height = primary.id.height();
    Reference reference;
    reference.visibility = Image<float>(width, height, 0);
    reference.sigma = Image<float>(width, height, 0);
    reference.edgeDistance = Image<float>(width, height, std::numeric_limits<float>::infinity());
    reference.surface = primary.surface;
    reference.id = primary.id;
    reference.position = primary.position;
    return reference;
}

void fillReceivers(const Image<float>& visible, const Image<float>& sigma, Reference& reference) {
    for (std::size_t i = 0; i < reference.surface.size(); ++i) {
        if (reference.surface[i] != Surface::Receiver) continue;
        reference.visibility[i] = visible[i];
        reference.sigma[i] = sigma[i];
    }
}

double primaryMismatch(const povray::Render& image, const PrimaryHits& primary) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < primary.id.size(); ++i) differing += (image.hit[i] != 0) != (primary.id[i] != 0);
    return static_cast<double>(differing) / static_cast<double>(primary.id.size());
}

void requireSamePrimaryHits(const Request& request, const povray::Render& image, double mismatch) {
    if (mismatch <= mostPrimaryMismatch) return;
    if (differOnSilhouettes(image, hard::primaryHits(request.snapshot, request.size))) return;
    requireUncutScene(request, image);
    throw InternalError(
        fmt::format("POV-Ray and the exact primary hits disagree on {:.2f} % of the pixels (at most {:.1f} %): "
                    "if shadowbench inspect SCENE warns of its size or its place, follow that; else their cameras are "
                    "misaligned: report this scene",
                    100 * mismatch, 100 * mostPrimaryMismatch));
}

} // namespace shadowbench::groundtruth
