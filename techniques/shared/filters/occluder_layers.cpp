#include "techniques/shared/filters/occluder_layers.h"

#include "techniques/gl/api.h"
#include "techniques/shared/filters/nearest_texel.h"
#include "techniques/shared/maps/depth_map.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr unsigned areasBinding = 3; // shared/filters/summed_areas.glsl

/// Fragments add their bits to those of a texel.
class BitsAdded {
public:
    BitsAdded() {
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_COLOR_LOGIC_OP);
        glLogicOp(GL_OR);
    }
    ~BitsAdded() { glDisable(GL_COLOR_LOGIC_OP); }
    BitsAdded(const BitsAdded&) = delete;
    BitsAdded& operator=(const BitsAdded&) = delete;
};

} // namespace

OccluderLayers::OccluderLayers(int side, gl::Program program)
    : bits_(gl::Format::R32UI, {side, side}), program_(std::move(program)),
      rows_(gl::Program::compute("shared/filters/sum_rows.comp")),
      columns_(gl::Program::compute("shared/filters/sum_columns.comp")) {}

void OccluderLayers::draw(const LightView& light, const Frame& frame, const std::vector<bool>& shown,
                          std::string_view name) {
    const auto pass = frame.pass(name);
    const gl::RenderTarget target({&bits_});
    target.clearColour(0, 0U);
    target.bind();
    const CasterPass casters(program_, light, Bias{});
    const BitsAdded added;
    frame.scene.draw(shown);
}

void OccluderLayers::sum(const Frame& frame, int layers) {
    const auto pass = frame.pass("summed areas");
    const auto side = static_cast<std::size_t>(bits_.size().x), count = static_cast<std::size_t>(layers);
    if (layers != summed_) areas_.clear(count * (side + 1) * (side + 1) * sizeof(std::uint32_t));
    summed_ = layers;
    areas_.bindStorage(areasBinding);
    rows_.set("bits", bits_).set("side", bits_.size().x).set("layers", layers);
    rows_.dispatch(side * count);
    columns_.set("side", bits_.size().x).set("layers", layers);
    columns_.dispatch(side * count);
}

std::vector<BarePass> OccluderLayers::bare(const LightView& light, const std::vector<bool>& shown, std::string_view name,
                                           std::string source, int layers) const {
    const glm::ivec2 size = bits_.size();
    std::vector<BarePass> passes{{.pass = name,
                                  .source = std::move(source),
                                  .size = size,
                                  .targets = {gl::Format::R32F},
                                  .casters = {{.clipFromWorld = light.clipFromWorld, .shown = shown}}}};
    const BarePass filter{.pass = "summed areas",
                          .source = "dissertation 2.3.3: each image prefiltered",
                          .size = size,
                          .targets = {gl::Format::R32F},
                          .taps = {{gl::Format::R32F, size, Read::Pixel}}};
    passes.insert(passes.end(), static_cast<std::size_t>(layers), filter);
    return passes;
}

int meanReads(const Frame& frame, const LightView& light, const std::function<int(double depth, unsigned id)>& reads) {
    const Image<glm::vec4> positions = frame.gbuffer.readPositions();
    const Image<unsigned> ids = frame.gbuffer.readIds();
    std::size_t all = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (positions[i].w < 0.5F) continue;
        const double depth = glm::dot(light.depthFromWorld, glm::dvec4(glm::dvec3(positions[i]), 1));
        if (depth > 0) all += static_cast<std::size_t>(reads(depth, ids[i]));
    }
    return static_cast<int>(all / positions.size());
}

void OccluderLayers::bindTo(gl::Program& resolve, const Light& light, const LightView& view) const {
    const double share = light.kind == LightKind::Disk ? 0.5 * std::sqrt(std::numbers::pi) : 1; // of the rectangle's sides
    areas_.bindStorage(areasBinding);
    resolve.set("side", bits_.size().x).set("lightTexels", glm::vec2(share / texelReach(light, view, bits_.size().x)));
}

} // namespace shadowbench::techniques
