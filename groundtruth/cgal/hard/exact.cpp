#include "groundtruth/cgal/hard/exact.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/pixel_area.h"
#include "groundtruth/cgal/hard/pixel_edges.h"
#include "groundtruth/cgal/hard/planar.h"
#include "groundtruth/cgal/hard/polygon.h"
#include "groundtruth/cgal/hard/rays.h"

#include <CGAL/version.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr int codeVersion = 3; // raise it with every change that can change a label or a distance

/// In a pixel that is left to rays: enough of them for σ ≤ 0.01 whatever it sees.
constexpr int raysAcross = 50;

constexpr int tileSide = 4; // pixels whose areas share what they look up

/// Gives the images of `out` their size and what is the same for every oracle.
void prepare(const PrimaryHits& primary, Reference& out) {
    if (out.visibility.sameSize(primary.id)) return;
    const int width = primary.id.width(), height = primary.id.height();
    out.visibility = Image<float>(width, height);
    out.sigma = Image<float>(width, height);
    out.surface = primary.surface;
    out.id = primary.id;
    out.position = primary.position;
    out.edgeDistance = Image<float>(width, height, std::numeric_limits<float>::infinity());
}

void requireHardLight(const Light& light) {
    if (light.isArea() || light.isEnvironment())
        throw InternalError("Hard shadow labels were asked for a light that is no point and no direction; use "
                            "Light::centreOnly for an area light's centre.");
}

void requireSize(const PrimaryHits& primary, glm::ivec2 size) {
    if (primary.id.width() != size.x || primary.id.height() != size.y)
        throw InternalError("Hard shadow labels were asked for an image size that is not that of the primary hits.");
}

} // namespace

struct ExactScene::Data {
    Data(const Snapshot& snapshot, std::shared_ptr<const SceneTriangles> prepared, int threadCount)
        : camera(snapshot.camera), light(snapshot.light), triangles(std::move(prepared)),
          occluders(*triangles, snapshot.light.centreOnly().homogeneous(), threadCount), threads(threadCount) {}

    Camera camera;
    Light light;
    std::shared_ptr<const SceneTriangles> triangles;
    Occluders occluders;
    int threads;
};

ExactScene::ExactScene(const Snapshot& snapshot, int threads)
    : ExactScene(snapshot, std::make_shared<const SceneTriangles>(snapshot), threads) {}

ExactScene::ExactScene(const Snapshot& snapshot, std::shared_ptr<const SceneTriangles> triangles, int threads)
    : data_(std::make_unique<Data>(snapshot, std::move(triangles), threads)) {}

ExactScene::~ExactScene() = default;

PrimaryHits ExactScene::primaryHits(glm::ivec2 size, const Progress& progress) const {
    return tracePrimary(*data_->triangles, data_->camera, data_->light, size, data_->threads, progress);
}

void ExactScene::labelByRays(glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress) const {
    requireSize(primary, size);
    requireHardLight(data_->light);
    prepare(primary, out);
    traceShadows(*data_->triangles, data_->camera, data_->light.homogeneous(), size, primary, data_->threads, out, progress);
    edgeDistanceFromLabels(out, data_->threads);
}

std::vector<PlanarReceiver> ExactScene::planarReceivers(const PrimaryHits& primary, std::size_t minimumPixels) const {
    return findPlanarReceivers(*data_->triangles, data_->camera.eye, primary, minimumPixels);
}

void ExactScene::labelByPolygon(glm::ivec2 size, const PrimaryHits& primary, const PlanarReceiver& receiver, Reference& out,
                                const Progress& progress, EdgeDistances distances) const {
    requireSize(primary, size);
    requireHardLight(data_->light);
    if (receiver.triangles.empty())
        throw InternalError("Polygon labels were asked for a planar receiver without triangles.");
    prepare(primary, out);
    labelPlane(data_->occluders, data_->camera, size, primary, receiver, distances, out, progress);
}

void ExactScene::averageOverPixels(glm::ivec2 size, const PrimaryHits& primary, Reference& out,
                                   const Progress& progress) const {
    requireSize(primary, size);
    requireHardLight(data_->light);
    prepare(primary, out);
    const PixelAreas areas(*data_->triangles, data_->camera, data_->light.homogeneous(), size);
    const auto average = [&](glm::ivec2 pixel, PixelAreas::Tile& tile) {
        if (primary.surface(pixel.x, pixel.y) != Surface::Receiver) return;
        const std::uint32_t id = primary.id(pixel.x, pixel.y);
        const std::optional<AreaShares> found = tile.of(pixel, id);
        const AreaShares shares =
            found ? *found : sharesByRays(*data_->triangles, data_->camera, data_->light, size, pixel, id, raysAcross);
        out.surface(pixel.x, pixel.y) = Surface::Receiver;
        if (shares.seen <= 0) return; // a sliver: its label stays
        out.visibility(pixel.x, pixel.y) = static_cast<float>(std::clamp(shares.lit / shares.seen, 0.0, 1.0));
        out.sigma(pixel.x, pixel.y) = static_cast<float>(shares.sigma);
    };
    const glm::ivec2 tiles = (size + tileSide - 1) / tileSide;
    inParallel(tiles.x * tiles.y, data_->threads, progress, "pixel areas", [&](int index) {
        const glm::ivec2 first = tileSide * glm::ivec2(index % tiles.x, index / tiles.x);
        const glm::ivec2 end = glm::min(first + tileSide, size);
        PixelAreas::Tile tile(areas, {first, end});
        for (int y = first.y; y < end.y; ++y)
            for (int x = first.x; x < end.x; ++x) average({x, y}, tile);
    });
}

ExactScene::PixelMean ExactScene::meanByRays(glm::ivec2 size, glm::ivec2 pixel, std::uint32_t surface, int side,
                                             std::uint16_t set) const {
    requireHardLight(data_->light);
    const AreaShares shares = sharesByRays(*data_->triangles, data_->camera, data_->light, size, pixel, surface, side, set);
    if (shares.seen <= 0) return {};
    return {shares.lit / shares.seen, shares.sigma, shares.seen};
}

PrimaryHits primaryHits(const Snapshot& snapshot, glm::ivec2 size, const Progress& progress) {
    return ExactScene(snapshot).primaryHits(size, progress);
}

void labelByRays(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, Reference& out,
                 const Progress& progress) {
    ExactScene(snapshot).labelByRays(size, primary, out, progress);
}

std::vector<PlanarReceiver> planarReceivers(const Snapshot& snapshot, const PrimaryHits& primary,
                                            std::size_t minimumPixels) {
    return ExactScene(snapshot).planarReceivers(primary, minimumPixels);
}

void labelByPolygon(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, const PlanarReceiver& receiver,
                    Reference& out, const Progress& progress) {
    ExactScene(snapshot).labelByPolygon(size, primary, receiver, out, progress);
}

std::map<std::string, std::string> toolVersions() {
    return {{"cgal", CGAL_VERSION_STR}, {"exact", std::to_string(codeVersion)}};
}

} // namespace shadowbench::groundtruth::hard
