// Convolution of occluders with the light's image (Soler and Sillion 1998), after Scherzer 2.3.3, Fig. 2.20:
// 1. the polygons of all blockers are put into clusters of like depth, which are split until each may be taken for a plane
//    parallel to the light, or there are too many;
// 2. every cluster is projected from the light's centre into a binary image;
// 3. the image is convolved with that of the light, which is as large as the light appears from the receiver through the
//    cluster's plane; what is left of the light is combined from all clusters.
// Exact where light, blockers and receivers lie in parallel planes. As the source admits, a polygon that is elongated in the
// light's direction cannot be broken down: it has the penumbra of its middle all along, and where it goes on below the
// ground that it stands on, the ground has a dark line along its foot. No shadow falls within a cluster; one that holds any
// part of a surface casts none on it, so that no surface shades itself. How clusters are combined the dissertation does not
// say. Here those of one range of depth, parts of a surface mostly, hide different parts of the light, so that what they
// hide is added; ranges that lie one behind the other are independent, and visibility is the product of theirs. Where they
// are neither, the shadow of the union is not theirs: too dark. Departures: the light's image is a box, so that summed areas
// convolve with one of any size (the paper takes Fourier transforms); the receiver's plane is the one through the receiver's
// own point, as a size of its own costs nothing then (the paper has one for each receiver); the paper's blockers and
// receivers are told apart by hand, here by their bounding boxes (shared/casters/blockers.h).
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/casters/blockers.h"
#include "techniques/shared/filters/occluder_layers.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/soft/convolution/clusters.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace shadowbench::techniques {
namespace {

constexpr unsigned surfacesBinding = 4, polygonsBinding = 5; // soft/convolution/layers_of.glsl

/// Of a surface: where its polygons begin among those of all blockers, and the layers that hold any of them.
struct GpuSurface {
    std::uint32_t firstPolygon = 0, layers = 0;
};

class Convolution final : public Technique {
public:
    explicit Convolution(const Parameters& p)
        : most_(static_cast<std::size_t>(p.integer("clusters"))), tolerance_(p.real("tolerance")),
          layers_(p.integer("map"), gl::Program("soft/convolution/occluders.vert", "soft/convolution/occluders.frag")),
          resolve_(gl::Program::screen("soft/convolution/convolution.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const LightView view = fitToScene(frame.snapshot.light, frame.snapshot);
        const std::vector<bool> shown = blockers(frame.snapshot);
        cluster(frame.snapshot, view, shown);
        layers_.draw(view, frame, shown, "blocker images");
        layers_.sum(frame, std::max(1, static_cast<int>(clusters_.size())));

        layers_.bindTo(resolve_, frame.snapshot.light, view);
        gpuSurfaces_.bindStorage(surfacesBinding);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(view))
            .set("depthFromWorld", glm::vec4(view.depthFromWorld))
            .set("ids", frame.gbuffer.id())
            .set("layers", static_cast<int>(clusters_.size()))
            .set("clusters", uniformClusters());
        resolve(frame, {&visibility}, resolve_, "convolution");
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"clusters", static_cast<double>(clusters_.size())}};
    }

private:
    /// Of each cluster: 1 / depth of its plane, and whether it is the last one of its group.
    [[nodiscard]] std::vector<glm::vec4> uniformClusters() const {
        std::vector<glm::vec4> result;
        for (std::size_t i = 0; i < clusters_.size(); ++i) {
            const bool isLast = i + 1 == clusters_.size() || clusters_[i + 1].group != clusters_[i].group;
            result.emplace_back(1 / clusters_[i].range.middle(), isLast ? 1 : 0, 0, 0);
        }
        result.resize(mostLayers);
        return result;
    }

    /// Puts the blockers' polygons into clusters and uploads the layers of each surface and polygon.
    void cluster(const Snapshot& snapshot, const LightView& view, const std::vector<bool>& shown) {
        const std::vector<BlockerPolygon> polygons = blockerPolygons(snapshot, view, shown);
        clusters_ = clustered(polygons, tolerance_ * (1 / view.near - 1 / view.far), most_);

        std::vector<GpuSurface> surfaces; // by id
        std::uint32_t count = 0;
        std::size_t number = 0;
        for (const Batch& batch : snapshot.batches)
            for (const Placement& placed : batch.placements) {
                if (placed.id >= surfaces.size()) surfaces.resize(placed.id + std::size_t{1});
                surfaces[placed.id].firstPolygon = count;
                if (shown[number++]) count += static_cast<std::uint32_t>(batch.mesh->triangles.size());
            }
        std::vector<std::uint32_t> layersOf(std::max(count, 1U));
        for (std::size_t layer = 0; layer < clusters_.size(); ++layer)
            for (const std::size_t i : clusters_[layer].members) {
                GpuSurface& surface = surfaces[polygons[i].surface];
                layersOf[surface.firstPolygon + polygons[i].number] = 1U << layer;
                surface.layers |= 1U << layer;
            }
        gpuSurfaces_.upload(surfaces.data(), surfaces.size() * sizeof(GpuSurface));
        gpuPolygons_.upload(layersOf.data(), layersOf.size() * sizeof(std::uint32_t));
        gpuSurfaces_.bindStorage(surfacesBinding);
        gpuPolygons_.bindStorage(polygonsBinding);
    }

    std::size_t most_;
    double tolerance_;
    std::vector<Cluster> clusters_; // of the frame rendered last
    OccluderLayers layers_;
    gl::Buffer gpuSurfaces_, gpuPolygons_;
    gl::Program resolve_;
};

} // namespace

Entry convolution() {
    return {
        .id = "convolution",
        .title = "Convolution of occluders with the light",
        .source = {Document::Dissertation, "2.3.3, Fig. 2.20"},
        .answer = Answer::Soft,
        .parameters = {{"map", "1024", IntegerRange{16, widestLayer}, "texels per side of the blockers' images",
                        "EGSR paper, 4"},
                       {"clusters", "8", IntegerRange{1, mostLayers}, "clusters of the blockers' polygons, at most", ""},
                       {"tolerance", "0.05", RealRange{0, 1},
                        "of the scene's widest penumbra: by how much those of one cluster may differ, as long as it can be "
                        "split",
                        ""}},
        .figures = {{"clusters", "images of blockers that are convolved"}},
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<Convolution>(p); }};
}

} // namespace shadowbench::techniques
