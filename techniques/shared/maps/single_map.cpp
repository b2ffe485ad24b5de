#include "techniques/shared/maps/single_map.h"

#include "techniques/gl/resolve.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/lispsm_view.h"

namespace shadowbench::techniques {
namespace {

class SingleMap final : public Technique {
public:
    SingleMap(std::unique_ptr<ShadowMap> map, FitView fit, TellFigures tell)
        : fit_(std::move(fit)), tell_(std::move(tell)), map_(std::move(map)),
          resolve_(gl::Program::screen("shared/maps/single_map.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        last_.emplace(frame);
        light_ = fit_(frame);
        map_->draw(light_, frame.scene);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_->texture());
        resolveInto({&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures() const override {
        return tell_ && last_ ? tell_(*last_) : std::map<std::string, double>{};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, map_->texture().size());
    }

private:
    FitView fit_;
    TellFigures tell_;
    std::optional<Frame> last_; // the frame last rendered, for `figures`
    LightView light_;
    std::unique_ptr<ShadowMap> map_;
    gl::Program resolve_;
};

} // namespace

std::unique_ptr<Technique> makeSingleMap(std::unique_ptr<ShadowMap> map, FitView fit, TellFigures figures) {
    return std::make_unique<SingleMap>(std::move(map), std::move(fit), std::move(figures));
}

std::unique_ptr<Technique> makeSingleMap(const Parameters& parameters, FitView fit) {
    return makeSingleMap(std::make_unique<DepthMap>(parameters.integer("map"), biasFrom(parameters), Lookup::Compare),
                         std::move(fit));
}

LightView uniformView(const Frame& frame) { return fitToScene(frame.snapshot.light.centreOnly(), frame.snapshot); }

LightView focusedView(const Frame& frame) {
    return fitFocused(frame.snapshot.light, frame.snapshot, frame.snapshot.camera, frame.aspect());
}

LightView lispsmView(const Frame& frame) {
    return fitLispsm(frame.snapshot.light, frame.snapshot, frame.snapshot.camera, frame.aspect());
}

} // namespace shadowbench::techniques
