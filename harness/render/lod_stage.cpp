#include "harness/render/lod_stage.h"

#include "base/trace.h"
#include "techniques/gl/context.h"

#include <cmath>

namespace shadowbench::lod {
namespace {

double aspect(glm::ivec2 size) { return static_cast<double>(size.x) / size.y; }

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(255 * value)); }

} // namespace

LodStage::LodStage(const Scene& scene, glm::ivec2 size)
    : scene_(scene), size_(size), chains_(chains(scene)), drawer_(chains_), colour_(gl::Format::RGBA8, size),
      depth_(gl::Format::Depth32F, size), target_{&colour_, &depth_}, mask_(size),
      shown_(walkFrame(scene, 0, aspect(size))) {}

void LodStage::show(int index) { shown_ = walkFrame(scene_, index, aspect(size_)); }

void LodStage::showStanding(int index) { shown_ = standingFrame(scene_, index, aspect(size_)); }

techniques::LodFrame LodStage::frame(techniques::PassListener* passes) {
    const double shape = aspect(size_);
    return {.chains = chains_,
            .instances = shown_.instances,
            .drawer = drawer_,
            .light = scene_.light.centreOnly().homogeneous(),
            .size = size_,
            .view = shown_.camera.view(),
            .previousView = shown_.previousCamera.view(),
            .projection = shown_.camera.projection(shape),
            .previousProjection = shown_.previousCamera.projection(shape),
            .passes = passes};
}

void LodStage::render(techniques::LodTechnique& technique, techniques::PassListener* passes) {
    const Span span("frame", "technique");
    technique.render(frame(passes), {colour_, depth_, target_});
    gl::Context::current().check("rendering the walk of scene " + scene_.id);
}

metrics::ColourImage LodStage::picture() const {
    const Span span("frame", "read picture");
    const Image<glm::vec4> pixels = target_.readVec4(0);
    metrics::ColourImage picture(pixels.width(), pixels.height());
    for (std::size_t i = 0; i < pixels.size(); ++i) picture[i] = {byte(pixels[i].x), byte(pixels[i].y), byte(pixels[i].z)};
    return picture;
}

Image<unsigned> LodStage::transitionMask() { return mask_.draw(frame()); }

} // namespace shadowbench::lod
