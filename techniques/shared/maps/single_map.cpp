#include "techniques/shared/maps/single_map.h"

#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/maps/normal_offset.h"

namespace shadowbench::techniques {
namespace {

class SingleMap final : public Technique {
public:
    SingleMap(std::unique_ptr<ShadowMap> map, FitView fit, Bias bias, ReportFigures report)
        : fit_(std::move(fit)), bias_(bias), report_(std::move(report)), map_(std::move(map)),
          resolve_(gl::Program::screen("shared/maps/single_map.frag", normalOffsetDefines(bias))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = fit_(frame);
        map_->draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_->texture());
        setNormalOffset(resolve_, frame, bias_, map_->texture().size());
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        return report_ ? report_(frame) : std::map<std::string, double>{};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, map_->texture().size());
    }

private:
    FitView fit_;
    Bias bias_;
    ReportFigures report_;
    LightView light_;
    std::unique_ptr<ShadowMap> map_;
    gl::Program resolve_;
};

} // namespace

std::unique_ptr<Technique> makeSingleMap(std::unique_ptr<ShadowMap> map, FitView fit, Bias bias, ReportFigures figures) {
    return std::make_unique<SingleMap>(std::move(map), std::move(fit), bias, std::move(figures));
}

std::unique_ptr<Technique> makeSingleMap(const Parameters& parameters, FitView fit) {
    const Bias bias = biasFrom(parameters);
    return makeSingleMap(std::make_unique<DepthMap>(parameters.integer("map"), bias, Lookup::Compare), std::move(fit), bias);
}

LightView uniformView(const Frame& frame) { return fitToScene(frame.hardLight, frame.snapshot); }

LightView focusedView(const Frame& frame) {
    return fitFocused(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect());
}

LightView lispsmView(const Frame& frame) {
    return fitLispsm(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect());
}

} // namespace shadowbench::techniques
