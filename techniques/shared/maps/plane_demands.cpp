#include "techniques/shared/maps/plane_demands.h"

#include <cmath>

namespace shadowbench::techniques {
namespace {

gl::Defines demandDefines(const std::optional<PlaneDemands::Discontinuity>& discontinuity) {
    if (!discontinuity) return {};
    return {{"DISCONTINUITY", "1"}, {"TILES", "6"}};
}

} // namespace

PlaneDemands::PlaneDemands(float most, const std::optional<Discontinuity>& discontinuity)
    : demand_(gl::Program::screen("shared/maps/demand.frag", demandDefines(discontinuity))) {
    demand_.set("most", most);
    if (!discontinuity) return;
    first_.emplace(discontinuity->side, discontinuity->bias);
    demand_.set("discontinuity", discontinuity->share);
}

void PlaneDemands::drawWholePlanes(const Frame& frame) {
    first_->setTiles(squareTiles(first_->texture().size().x, static_cast<int>(planes_.size())));
    first_->draw(planes_, frame);
    first_->bindTo(demand_);
}

std::vector<glm::mat4> PlaneDemands::planeFromWorld() const {
    std::vector<glm::mat4> matrices;
    for (const LightView& plane : planes_) matrices.push_back(mapFromWorld(plane));
    return matrices;
}

const std::vector<Demand>& PlaneDemands::of(const Frame& frame, const gl::Texture& visibility) {
    planes_ = lightPlanes(frame.hardLight, frame.snapshot);
    if (first_) drawWholePlanes(frame);
    const auto pass = frame.pass("demands");
    if (!texture_ || texture_->size() != frame.size) texture_.emplace(gl::Format::RGBA32F, frame.size);
    demand_.set("planes", static_cast<int>(planes_.size()))
        .set("planeFromWorld", planeFromWorld())
        .set("light", glm::vec4(frame.hardLight.homogeneous()))
        .set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("clipFromWorld", glm::mat4(frame.clipFromWorld));
    const gl::RenderTarget target({&*texture_, &visibility});
    target.bind();
    demand_.drawScreen();

    demands_.clear();
    for (const glm::vec4& d : target.readVec4(0)) {
        if (d.z == 0) continue;
        const float plane = std::floor(d.x);
        demands_.push_back({static_cast<int>(plane), {d.x - plane, d.y}, {d.z, d.w}});
    }
    return demands_;
}

void PlaneDemands::bindTo(gl::Program& program, const Frame& frame) const {
    program.set("positions", frame.gbuffer.position()).set("demands", *texture_).set("planeFromWorld", planeFromWorld());
}

} // namespace shadowbench::techniques
