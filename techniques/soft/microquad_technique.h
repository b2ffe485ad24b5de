// A technique that projects the microquads of a map of linear depths back onto the light.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/shared/filters/microquads.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::techniques {

/// `Map` is drawn as LinearDepthMap and PeeledMap are.
template <class Map>
class MicroquadTechnique final : public Technique {
public:
    /// `p` hold microquadParameters and depthMapParameters; `layers`: of the map.
    MicroquadTechnique(const Parameters& p, int layers, Map map)
        : layers_(layers), microquads_(p, layers), map_(std::move(map)), pyramid_(p.integer("map"), nodeEnds(p), layers) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        pyramid_.draw(map_.texture(), frame);
        microquads_.resolve(frame, view_, map_.texture(), pyramid_, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        return {{"quads", microquads_.quadsOf(frame, view_, map_.texture(), pyramid_)}};
    }

    [[nodiscard]] std::vector<BarePass> bare(const Frame& frame) const override {
        const auto lookup = microquads_.bare(frame, view_, map_.texture(), pyramid_);
        if (!lookup) return {};
        const int side = map_.texture().size().x;
        std::vector<BarePass> passes(static_cast<std::size_t>(layers_),
                                     bareDepthMap("dissertation 2.3.4: a map of each layer", side, view_.clipFromWorld));
        for (std::size_t layer = 1; layer < passes.size(); ++layer) {
            passes[layer].pass = "depth peeling";
            // Its vertices alone, for all is clipped: what lies behind the layer before it depends on the scene.
            passes[layer].casters.front().plane = glm::dvec4(0, 0, 0, -1);
        }
        passes.insert(passes.end(), static_cast<std::size_t>(layers_), barePyramid(side));
        passes.push_back(*lookup);
        return passes;
    }

private:
    int layers_;
    Microquads microquads_;
    LightView view_; // of the frame rendered last
    Map map_;
    MinMaxPyramid pyramid_;
};

} // namespace shadowbench::techniques
