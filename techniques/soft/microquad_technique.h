// A technique that projects the microquads of a map of linear depths back onto the light.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/shared/filters/microquads.h"

#include <map>
#include <string>
#include <utility>

namespace shadowbench::techniques {

/// `Map` is drawn as LinearDepthMap and PeeledMap are.
template <class Map>
class MicroquadTechnique final : public Technique {
public:
    /// `p` hold microquadParameters and depthMapParameters; `layers`: of the map.
    MicroquadTechnique(const Parameters& p, int layers, Map map)
        : microquads_(p, layers), map_(std::move(map)), pyramid_(p.integer("map"), nodeEnds(p), layers) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        pyramid_.draw(map_.texture(), frame);
        microquads_.resolve(frame, view_, map_.texture(), pyramid_, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        return {{"quads", microquads_.quadsOf(frame, view_, map_.texture(), pyramid_)}};
    }

private:
    Microquads microquads_;
    LightView view_; // of the frame rendered last
    Map map_;
    MinMaxPyramid pyramid_;
};

} // namespace shadowbench::techniques
