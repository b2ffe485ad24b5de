#include "harness/render/stage.h"

#include "base/trace.h"
#include "techniques/gl/context.h"

namespace shadowbench {
namespace {

glm::dmat4 clipFromWorld(const Camera& camera, glm::ivec2 size) {
    return camera.projection(static_cast<double>(size.x) / size.y) * camera.view();
}

Image<glm::vec3> firstThree(const Image<glm::vec4>& image) {
    Image<glm::vec3> result(image.width(), image.height());
    for (std::size_t i = 0; i < image.size(); ++i) result[i] = glm::vec3(image[i]);
    return result;
}

} // namespace

Stage::Stage(const Scene& scene)
    : scene_(scene), gbuffer_(scene.size), visibility_(gl::Format::R32F, scene.size), target_{&visibility_} {}

void Stage::show(int index) { show(snapshot(scene_, index)); }

void Stage::show(const Snapshot& shown) {
    const Span span("frame", "scene and G-buffer");
    snapshot_ = shown;
    hardLight_ = snapshot_.light.centreOnly();
    buffers_.update(snapshot_);
    redraw();
}

void Stage::cast(const std::vector<Batch>& casters) {
    snapshot_.batches = casters;
    buffers_.update(snapshot_);
}

void Stage::redraw(techniques::PassListener* passes) {
    const techniques::Pass pass("G-buffer", passes);
    gbuffer_.draw(buffers_, clipFromWorld(snapshot_.camera, scene_.size));
}

metrics::Drawn Stage::drawn() const {
    const Span span("frame", "read G-buffer");
    return {gbuffer_.readIds(), firstThree(gbuffer_.readPositions())};
}

Image<glm::vec3> Stage::normals() const {
    const Span span("frame", "read G-buffer");
    return firstThree(gbuffer_.readNormals());
}

Image<float> Stage::visibility() const {
    const Span span("frame", "read visibility");
    return target_.readFloat(0);
}

techniques::Frame Stage::frame(int index, std::uint32_t seed, techniques::PassListener* passes) const {
    return {.snapshot = snapshot_,
            .hardLight = hardLight_,
            .scene = buffers_,
            .gbuffer = gbuffer_,
            .size = scene_.size,
            .clipFromWorld = clipFromWorld(snapshot_.camera, scene_.size),
            .previousClipFromWorld = clipFromWorld(snapshot_.previousCamera, scene_.size),
            .index = index,
            .seed = seed,
            .passes = passes};
}

void Stage::render(techniques::Technique& technique, int index, std::uint32_t seed, techniques::PassListener* passes) {
    const Span span("frame", "technique");
    technique.render(frame(index, seed, passes), visibility_);
    gl::Context::current().check("rendering frame " + std::to_string(index) + " of scene " + scene_.id);
}

} // namespace shadowbench
