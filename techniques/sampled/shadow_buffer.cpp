#include "techniques/sampled/shadow_buffer.h"

#include "techniques/contract/resolve.h"
#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {

std::vector<Parameter> shadowBufferParameters() {
    return {
        {"depth-test", "relative", OneOf{{"relative", "absolute"}},
         "of reprojection: tolerance relative to the depth, or in metres", "dissertation eq. 4.8 and 4.4"},
        {"epsilon", "0.01", RealRange{1e-5, 1}, "depth tolerance of reprojection", "dissertation eq. 4.8"},
        {"overscan", "0.05", RealRange{0, 0.5}, "share by which the shadow buffer is larger than the image",
         "dissertation 4.2"},
    };
}

std::vector<Figure> shadowBufferFigures() {
    return {{"shadow_buffer_bytes", "bytes of both shadow buffers for a pixel of the image"},
            {"reused", "share of the surface pixels that took over what the frame before had left"}};
}

gl::Defines shadowBufferDefines(const Parameters& parameters) {
    return {{"RELATIVE_DEPTH", parameters.text("depth-test") == "relative" ? "1" : "0"}};
}

LightView lightSampleView(const Frame& frame) {
    const Light& light = frame.snapshot.light;
    const std::uint32_t i = haltonIndex(frame.index, frame.seed);
    return fitFromSample(light, light.sample({halton(i, 2), halton(i, 3)}), boundingCorners(frame.snapshot));
}

ShadowBuffer::Images::Images(glm::ivec2 size, int border)
    : inner(size), gbuffer(size, border), read(gl::Format::RGBA16F, gbuffer.size(), gl::Filter::Linear),
      write(gl::Format::RGBA16F, gbuffer.size(), gl::Filter::Linear), shown(gl::Format::R32F, gbuffer.size()) {}

ShadowBuffer::ShadowBuffer(const Parameters& parameters)
    : epsilon_(static_cast<float>(parameters.real("epsilon"))), overscan_(parameters.real("overscan")),
      copy_(gl::Program::screen("sampled/inner_part.frag")) {}

void ShadowBuffer::begin(const Frame& frame) {
    if (!images_ || images_->inner != frame.size)
        images_.emplace(frame.size, static_cast<int>(std::ceil(0.5 * overscan_ * frame.size.x)));
    const auto pass = frame.pass("overscan G-buffer");
    images_->gbuffer.draw(frame.scene, frame.clipFromWorld);
}

void ShadowBuffer::update(const Frame& frame, gl::Program& program, const gl::Texture& visibility) {
    setReprojection(frame, program);
    resolve(frame, {&images_->shown, &images_->write}, program, "temporal resolve");
    std::swap(images_->read, images_->write);
    images_->fresh = false;

    copy_.set("wide", images_->shown).set("border", gbuffer().border());
    resolve(frame, {&visibility}, copy_, "crop");
}

std::map<std::string, double> ShadowBuffer::figures(int firstSamples) const {
    const Image<glm::vec4> buffer = gl::RenderTarget({&images_->read}).readVec4(0);
    const auto counts = [&](float least) {
        return static_cast<double>(std::ranges::count_if(buffer, [&](const glm::vec4& pixel) { return pixel.y > least; }));
    };
    const double surface = counts(0), pixels = static_cast<double>(images_->inner.x) * images_->inner.y;
    return {{"shadow_buffer_bytes", static_cast<double>(images_->read.bytes() + images_->write.bytes()) / pixels},
            {"reused", surface > 0 ? counts(static_cast<float>(firstSamples)) / surface : 0}};
}

void ShadowBuffer::setReprojection(const Frame& frame, gl::Program& program) const {
    const Camera& camera = frame.snapshot.camera;
    const glm::dvec3 forward = camera.basis().forward;
    const glm::dvec3 previousForward = frame.snapshot.previousCamera.basis().forward;
    const auto plane = [](const glm::dvec3& axis, const glm::dvec3& eye) {
        return glm::vec4(glm::dvec4(axis, -glm::dot(axis, eye)));
    };
    program.set("positions", gbuffer().position())
        .set("previousPositions", gbuffer().previousPosition())
        .set("shadowBuffer", images_->read)
        .set("previousClipFromWorld", glm::mat4(gbuffer().widened(frame.previousClipFromWorld)))
        .set("eyeDepth", plane(forward, camera.eye))
        .set("previousEyeDepth", plane(previousForward, frame.snapshot.previousCamera.eye))
        .set("epsilon", epsilon_)
        .set("hasHistory", images_->fresh ? 0 : 1);
}

} // namespace shadowbench::techniques
