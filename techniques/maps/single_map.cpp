#include "techniques/maps/single_map.h"

#include "techniques/resolve.h"

namespace shadowbench::techniques {
namespace {

class SingleMap final : public Technique {
public:
    SingleMap(const Parameters& parameters, FitView fit)
        : fit_(std::move(fit)), map_(parameters.integer("map"), biasFrom(parameters), Lookup::Compare),
          resolve_(gl::Program::screen("maps/single_map.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const LightView light = fit_(frame);
        map_.draw(light, frame.scene);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light))
            .set("depthMap", map_.texture());
        resolveInto({&visibility}, resolve_);
    }

private:
    FitView fit_;
    DepthMap map_;
    gl::Program resolve_;
};

} // namespace

std::unique_ptr<Technique> makeSingleMap(const Parameters& parameters, FitView fit) {
    return std::make_unique<SingleMap>(parameters, std::move(fit));
}

LightView uniformView(const Frame& frame) { return fitToScene(frame.snapshot.light.centreOnly(), frame.snapshot); }

LightView lispsmView(const Frame& frame) {
    return fitLispsm(frame.snapshot.light, frame.snapshot, static_cast<double>(frame.size.x) / frame.size.y);
}

} // namespace shadowbench::techniques
