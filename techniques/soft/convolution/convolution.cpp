// Convolution of occluders with the light's image (Soler and Sillion 1998), after Scherzer 2.3.3, Fig. 2.20:
// 1. blockers are put into clusters of like depth, which are split until each may be taken for a plane parallel to the
// light,
//    or there are too many;
// 2. every cluster is projected from the light's centre into a binary image;
// 3. the image is convolved with that of the light, which is as large as the light appears from the receiver through the
//    blocker's plane; what is left of the light after all clusters is their product.
// Exact where light, blockers and receivers lie in parallel planes. What spreads in depth, such as a slanted plate, has the
// penumbra of its middle all along, and no shadow falls within a cluster. Departures: the light's image is a box, so that
// summed areas convolve with one of any size (the paper takes Fourier transforms); the receiver's plane is the one through
// the receiver's own point, as a size of its own costs nothing then (the paper has one for each receiver); the paper's
// blockers and receivers are told apart by hand, here by their bounding boxes (shared/casters/blockers.h).
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

constexpr unsigned layersBinding = 4; // soft/convolution/layer_of.glsl
constexpr std::uint32_t noLayer = mostLayers;

class Convolution final : public Technique {
public:
    explicit Convolution(const Parameters& p)
        : most_(p.integer("clusters")), tolerance_(p.real("tolerance")),
          layers_(p.integer("map"), gl::Program("soft/convolution/occluders.vert", "soft/convolution/occluders.frag")),
          resolve_(gl::Program::screen("soft/convolution/convolution.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        const std::vector<bool> shown = blockers(frame.snapshot);
        cluster(frame.snapshot, view_, shown);
        layers_.draw(view_, frame, shown, "blocker images");
        layers_.sum(frame, std::max<int>(1, static_cast<int>(clusters_.ranges.size())));

        std::vector<glm::vec4> inverseDepths;
        for (const BlockerDepths& range : clusters_.ranges) inverseDepths.emplace_back(1 / range.middle(), 0, 0, 0);
        inverseDepths.resize(mostLayers);
        layers_.bindTo(resolve_, frame.snapshot.light, view_);
        layerOf_.bindStorage(layersBinding);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(view_))
            .set("depthFromWorld", glm::vec4(view_.depthFromWorld))
            .set("ids", frame.gbuffer.id())
            .set("layers", static_cast<int>(clusters_.ranges.size()))
            .set("inverseDepths", inverseDepths);
        resolve(frame, {&visibility}, resolve_, "convolution");
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"clusters", static_cast<double>(clusters_.ranges.size())}};
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        std::vector<BarePass> passes =
            layers_.bare(view_, blockers(frame.snapshot), "blocker images", "dissertation 2.3.3: an image of each cluster",
                         static_cast<int>(clusters_.ranges.size()));
        const int reads = meanReads(frame, view_, [this](double depth, unsigned id) { return clustersBefore(depth, id); });
        passes.push_back(bareLookup("convolution", "an image convolved with the light for each cluster before a pixel",
                                    frame.size, {{gl::Format::R32F, layers_.bits().size(), Read::Linear, reads}}));
        return passes;
    }

private:
    /// Those that may hide light from a surface at this depth: not its own.
    [[nodiscard]] int clustersBefore(double depth, unsigned id) const {
        int before = 0;
        for (std::size_t layer = 0; layer < clusters_.ranges.size(); ++layer)
            before += layer != layerOfId_.at(id) && clusters_.ranges[layer].middle() < depth ? 1 : 0;
        return before;
    }

    /// Puts the blockers into clusters and uploads the layer of each surface id.
    void cluster(const Snapshot& snapshot, const LightView& view, const std::vector<bool>& shown) {
        std::vector<BlockerDepths> ranges;
        const std::vector<glm::dvec3> corners = boundingCorners(snapshot);
        for (std::size_t i = 0; i < shown.size(); ++i)
            if (shown[i]) ranges.push_back(depthsOf(corners, 8 * i, view));
        clusters_ = clustered(ranges, tolerance_ * (1 / view.near - 1 / view.far), most_);

        layerOfId_.clear();
        std::size_t placement = 0, blocker = 0;
        for (const Batch& batch : snapshot.batches)
            for (const Placement& placed : batch.placements) {
                if (placed.id >= layerOfId_.size()) layerOfId_.resize(placed.id + std::size_t{1}, noLayer);
                if (shown[placement++]) layerOfId_[placed.id] = static_cast<std::uint32_t>(clusters_.of[blocker++]);
            }
        layerOf_.upload(layerOfId_.data(), layerOfId_.size() * sizeof(std::uint32_t));
        layerOf_.bindStorage(layersBinding);
    }

    /// Of the eight corners from `first` on, held in front of the view's near plane.
    static BlockerDepths depthsOf(const std::vector<glm::dvec3>& corners, std::size_t first, const LightView& view) {
        BlockerDepths range{view.far, view.near};
        for (std::size_t i = first; i < first + 8; ++i) {
            const double depth = std::max(glm::dot(view.depthFromWorld, glm::dvec4(corners[i], 1)), view.near);
            range.near = std::min(range.near, depth);
            range.far = std::max(range.far, depth);
        }
        return range;
    }

    int most_;
    double tolerance_;
    LightView view_; // of the frame rendered last, as are the next two
    Clusters clusters_;
    std::vector<std::uint32_t> layerOfId_;
    OccluderLayers layers_;
    gl::Buffer layerOf_;
    gl::Program resolve_;
};

} // namespace

Entry convolution() {
    return {
        .id = "convolution",
        .title = "Convolution of occluders with the light",
        .source = {Document::Dissertation, "2.3.3, Fig. 2.20"},
        .answer = Answer::Soft,
        .parameters = {{"map", "512", IntegerRange{16, widestLayer}, "texels per side of the blockers' images",
                        "EGSR paper, 4"},
                       {"clusters", "8", IntegerRange{1, mostLayers}, "clusters of blockers, at most", ""},
                       {"tolerance", "0.05", RealRange{0, 1},
                        "of the scene's widest penumbra: by how much those of one cluster may differ, as long as it can be "
                        "split",
                        ""}},
        .figures = {{"clusters", "images of blockers that are convolved"}},
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<Convolution>(p); }};
}

} // namespace shadowbench::techniques
