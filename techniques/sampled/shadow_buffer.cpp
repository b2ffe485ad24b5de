#include "techniques/sampled/shadow_buffer.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

/// `origin`: the shadow buffer's pixel that the G-buffer's first one is.
void setGBuffer(gl::Program& program, const gl::GBuffer& gbuffer, glm::ivec2 origin) {
    program.set("positions", gbuffer.position())
        .set("previousPositions", gbuffer.previousPosition())
        .set("gbufferOrigin", glm::vec2(origin));
    if (program.uses("normals")) program.set("normals", gbuffer.normal());
}

/// Stencil 1 in all but the border.
void markInner(const gl::GBuffer& gbuffer) {
    const gl::RenderTarget target({&gbuffer.depthStencil()});
    target.clearStencil();
    const glm::ivec2 inner = gbuffer.size() - 2 * gbuffer.border();
    glEnable(GL_SCISSOR_TEST);
    glScissor(gbuffer.border().x, gbuffer.border().y, inner.x, inner.y);
    constexpr GLint one = 1;
    glClearBufferiv(GL_STENCIL, 0, &one);
    glDisable(GL_SCISSOR_TEST);
}

/// The full-screen pass in a rectangle alone.
void drawScissored(const gl::Program& program, glm::ivec2 at, glm::ivec2 size) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(at.x, at.y, size.x, size.y);
    program.drawScreen();
    glDisable(GL_SCISSOR_TEST);
}

} // namespace

std::vector<Parameter> shadowBufferParameters() {
    return {
        {"depth-test", "relative", OneOf{{"relative", "absolute"}},
         "of reprojection: tolerance relative to the depth, or in metres", "dissertation eq. 4.8 and 4.4"},
        {"epsilon", "0.01", RealRange{1e-5, 1}, "depth tolerance of reprojection", "dissertation eq. 4.8"},
        {"overscan", "0.05", RealRange{0, 0.5}, "share by which the shadow buffer is wider and higher than the image",
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
    const glm::dvec2 sample(haltonOf(frame.index, frame.seed, 2), haltonOf(frame.index, frame.seed, 3));
    return fitFromSample(light, light.sample(sample), frame.snapshot);
}

ShadowBuffer::Images::Images(glm::ivec2 size, glm::ivec2 border)
    : inner(size), overscan(size, border), read(gl::Format::RGBA16F, overscan.size(), gl::Filter::Linear),
      write(gl::Format::RGBA16F, overscan.size(), gl::Filter::Linear), shown(gl::Format::R32F, overscan.size()) {
    markInner(overscan);
}

ShadowBuffer::ShadowBuffer(const Parameters& parameters)
    : epsilon_(static_cast<float>(parameters.real("epsilon"))), overscan_(parameters.real("overscan")) {}

void ShadowBuffer::begin(const Frame& frame) {
    if (!images_ || images_->inner != frame.size)
        images_.emplace(frame.size, glm::ivec2(glm::ceil(0.5 * overscan_ * glm::dvec2(frame.size))));
    if (images_->overscan.border() == glm::ivec2(0)) return;
    const auto pass = frame.pass("overscan G-buffer");
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 0, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    images_->overscan.draw(frame.scene, frame.clipFromWorld);
    glDisable(GL_STENCIL_TEST);
}

void ShadowBuffer::update(const Frame& frame, gl::Program& program, const gl::Texture& visibility) {
    setReprojection(frame, program);
    {
        const auto pass = frame.pass("temporal resolve");
        const gl::RenderTarget target({&images_->shown, &images_->write});
        target.bind();
        drawInner(frame, program);
        drawOverscan(program);
    }
    std::swap(images_->read, images_->write);
    images_->fresh = false;

    crop(frame, visibility);
}

/// A copy of texels, without a shader.
void ShadowBuffer::crop(const Frame& frame, const gl::Texture& visibility) const {
    const auto pass = frame.pass("crop");
    const glm::ivec2 border = images_->overscan.border(), size = images_->inner;
    glCopyImageSubData(images_->shown.id(), GL_TEXTURE_2D, 0, border.x, border.y, 0, visibility.id(), GL_TEXTURE_2D, 0, 0, 0,
                       0, size.x, size.y, 1);
    ++gl::Context::current().tally().passes;
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
    program.set("shadowBuffer", images_->read)
        .set("previousClipFromWorld", glm::mat4(images_->overscan.widened(frame.previousClipFromWorld)))
        .set("eyeDepth", plane(forward, camera.eye))
        .set("previousEyeDepth", plane(previousForward, frame.snapshot.previousCamera.eye))
        .set("epsilon", epsilon_)
        .set("hasHistory", images_->fresh ? 0 : 1);
}

void ShadowBuffer::drawInner(const Frame& frame, gl::Program& program) const {
    const glm::ivec2 border = images_->overscan.border();
    setGBuffer(program, frame.gbuffer, border);
    drawScissored(program, border, images_->inner);
}

void ShadowBuffer::drawOverscan(gl::Program& program) const {
    const glm::ivec2 border = images_->overscan.border();
    if (border == glm::ivec2(0)) return;
    const glm::ivec2 wide = images_->overscan.size(), inner = images_->inner;
    setGBuffer(program, images_->overscan, glm::ivec2(0));
    drawScissored(program, {0, 0}, {wide.x, border.y});
    drawScissored(program, {0, wide.y - border.y}, {wide.x, border.y});
    drawScissored(program, {0, border.y}, {border.x, inner.y});
    drawScissored(program, {wide.x - border.x, border.y}, {border.x, inner.y});
}

} // namespace shadowbench::techniques
