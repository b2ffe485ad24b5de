#include "techniques/shared/filters/occluder_layers.h"

#include "techniques/gl/api.h"
#include "techniques/shared/filters/nearest_texel.h"
#include "techniques/shared/maps/depth_map.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
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

void OccluderLayers::bindTo(gl::Program& resolve, const Light& light, const LightView& view) const {
    const double share = light.kind == LightKind::Disk ? 0.5 * std::sqrt(std::numbers::pi) : 1; // of the rectangle's sides
    areas_.bindStorage(areasBinding);
    resolve.set("side", bits_.size().x).set("lightTexels", glm::vec2(share / texelReach(light, view, bits_.size().x)));
}

} // namespace shadowbench::techniques
