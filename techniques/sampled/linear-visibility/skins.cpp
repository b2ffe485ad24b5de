#include "techniques/sampled/linear-visibility/skins.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/read_buffer.h"

#include <array>
#include <cstddef>

namespace shadowbench::techniques {
namespace {

constexpr float noSkin = 2; // above all visibilities: the least one is kept

std::size_t cellsOf(int side) { return static_cast<std::size_t>(side - 1) * static_cast<std::size_t>(side - 1); }

} // namespace

double gapOfOneTexel(const LineEnd& end, double length) { return end.view.span.x / (end.map.side() * length); }

LineEnd::LineEnd(int side)
    : map(side, Bias{}), visibility(gl::Format::R32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar) {}

Skins::Skins(int side)
    : find_(gl::Program::compute("sampled/linear-visibility/skins.comp")),
      draw_("sampled/linear-visibility/skins.vert", "sampled/linear-visibility/skins.frag") {
    cells_.clear(cellsOf(side) * sizeof(std::uint32_t));
}

void Skins::beginFrame() { total_.clear(sizeof(std::uint32_t)); }

void Skins::draw(const Frame& frame, const LineEnd& from, const LineEnd& to, double distance) {
    const double leastGap = gapOfOneTexel(from, distance);
    {
        const auto pass = frame.pass("depth discontinuities");
        find(from, leastGap);
    }
    const auto pass = frame.pass("visibility map");
    drawFound(from, to, leastGap);
}

void Skins::find(const LineEnd& from, double leastGap) {
    constexpr std::array<std::uint32_t, 4> nothing{0, 1, 0, 0}; // one instance of as many vertices as will be found
    command_.upload(nothing.data(), sizeof nothing);
    unsigned binding = 0; // skins.comp
    for (const gl::Buffer* buffer : {&command_, &cells_, &total_}) buffer->bindStorage(binding++);
    find_.set("linearDepth", from.map.texture())
        .set("deepest", static_cast<float>(from.view.far))
        .set("leastGap", static_cast<float>(leastGap));
    find_.dispatch(cellsOf(from.map.side()));
}

/// Where skins overlap, each hides the light from its own edge on: the least of their visibilities is left.
void Skins::drawFound(const LineEnd& from, const LineEnd& to, double leastGap) {
    const gl::RenderTarget target({&to.visibility});
    target.clearColour(0, glm::vec4(noSkin));
    target.bind();
    const glm::dmat4 mapFromTexel = mapFromClip() * to.view.clipFromWorld * worldFromTexel(from.view);
    draw_.set("linearDepth", from.map.texture())
        .set("deepest", static_cast<float>(from.view.far))
        .set("otherDepth", to.map.texture())
        .set("mapFromTexel", glm::mat4(mapFromTexel))
        .set("leastGap", static_cast<float>(leastGap));
    draw_.use();
    cells_.bindStorage(1);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_MIN);
    glBindVertexArray(gl::Context::current().noAttributes());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.id());
    glDrawArraysIndirect(GL_TRIANGLES, nullptr);
    ++gl::Context::current().tally().draws;
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
}

std::uint32_t Skins::count() const { return gl::readWords(total_, 1).front(); }

} // namespace shadowbench::techniques
