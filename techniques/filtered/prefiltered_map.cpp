#include "techniques/filtered/prefiltered_map.h"

#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/single_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {
namespace {

constexpr int widest = 8; // texels of a box that are read one by one

/// The view with `rim` texels of `side` left free on every side of the map.
LightView withFreeRim(LightView view, int rim, int side) {
    const double share = std::max(1 - 2.0 * rim / side, 0.5);
    view.clipFromWorld = glm::scale(glm::dmat4(1), glm::dvec3(share, share, 1)) * view.clipFromWorld;
    return view;
}

/// The view with depth counted from its near plane on. A directional light's own has no origin, and a linear depth map keeps
/// the sign of its depths for something else.
LightView withDepthFromNear(LightView view) {
    if (view.perspective) return view;
    view.depthFromWorld.w -= view.near;
    view.far -= view.near;
    view.near = 0;
    return view;
}

/// One of the box's two passes.
gl::Program boxPass(const BoxFilter& box, bool alongX) {
    int reach = 0;
    while (boxWeight(box.width, reach + 1) > 0) ++reach;
    gl::Defines defines{{"REACH", std::to_string(reach)}};
    if (alongX) defines.emplace_back("ALONG_X", "1");
    return gl::Program::screen("filtered/box.frag", defines);
}

/// From clip space to pixels.
glm::dmat4 imageFromClip(glm::ivec2 size) {
    const glm::dmat4 half = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * glm::dvec2(size), 1));
    return half * glm::translate(glm::dmat4(1), glm::dvec3(1, 1, 0));
}

int sideAt(int level, int side) { return std::max(side >> level, 1); }

} // namespace

BoxFilter boxFilter(int kernel) {
    BoxFilter box{0, static_cast<double>(kernel)};
    for (; box.width > widest; box.width /= 2) ++box.level;
    return box;
}

double boxWeight(double width, int offset) { return std::clamp(0.5 * width + 0.5 - std::abs(offset), 0.0, 1.0); }

int freeRim(const BoxFilter& box) {
    // Half the box, the texel that its mean is interpolated from, and what rasterisation may add.
    return static_cast<int>(std::ceil(0.5 * box.width + 1)) * (1 << box.level) + 1;
}

glm::dvec4 unitDepthFromWorld(const LightView& light) {
    return (light.depthFromWorld - glm::dvec4(0, 0, 0, light.near)) / (light.far - light.near);
}

std::vector<Parameter> prefilteredMapParameters() {
    std::vector<Parameter> parameters = depthMapParameters();
    for (Parameter& parameter : parameters) {
        // The mean over a slanted plane is the plane's own depth: no offset has to grow with the slope.
        if (parameter.name == "bias") parameter.defaultValue = "constant";
    }
    parameters.insert(parameters.begin() + 1,
                      {"kernel", "7", IntegerRange{1, 64}, "texels per side of the box that the map is averaged over", ""});
    return parameters;
}

PrefilteredMap::PrefilteredMap(const Parameters& parameters, const Basis& basis)
    : box_(boxFilter(parameters.integer("kernel"))), depth_(parameters.integer("map"), biasFrom(parameters)),
      stored_(basis.format, {depth_.side(), depth_.side()}, basis.layers),
      filtered_(basis.format, glm::ivec2(sideAt(box_.level, depth_.side())), basis.layers),
      rows_(basis.format, filtered_.size()), rowsTarget_{&rows_}, basis_(gl::Program::screen(basis.file, basis.defines)),
      alongX_(boxPass(box_, true)), alongY_(boxPass(box_, false)) {}

void PrefilteredMap::draw(const Frame& frame) {
    light_ = withFreeRim(withDepthFromNear(uniformView(frame)), freeRim(box_), depth_.side());
    depth_.draw(light_, frame);
    storeBasis(frame);
    blur(frame);
}

void PrefilteredMap::storeBasis(const Frame& frame) {
    const auto pass = frame.pass("basis");
    basis_.set("linearDepth", depth_.texture()).set("depthRange", glm::vec2(light_.near, light_.far));
    for (int layer = 0; layer < stored_.layers(); ++layer) {
        if (basis_.uses("layer")) basis_.set("layer", layer);
        const gl::RenderTarget target(stored_, layer);
        target.bind();
        basis_.drawScreen();
    }
}

void PrefilteredMap::blur(const Frame& frame) {
    const auto pass = frame.pass("blur");
    if (box_.level > 0) stored_.makeMipmaps();
    for (int layer = 0; layer < stored_.layers(); ++layer) filter(layer);
    filtered_.makeMipmaps();
}

void PrefilteredMap::filter(int layer) {
    const auto width = static_cast<float>(box_.width);
    alongX_.set("stored", stored_).set("layer", layer).set("level", box_.level).set("width", width);
    rowsTarget_.bind();
    alongX_.drawScreen();

    alongY_.set("rows", rows_).set("width", width);
    const gl::RenderTarget target(filtered_, layer);
    target.bind();
    alongY_.drawScreen();
}

std::vector<BarePass> PrefilteredMap::bare(const Frame& frame, const std::string& source) const {
    const gl::Format format = rows_.format();
    const glm::ivec2 side = stored_.size(), filteredSide = filtered_.size();
    const int width = static_cast<int>(std::ceil(box_.width));
    std::vector<BarePass> passes{bareDepthMap("course, Shadow Mapping", depth_.side(), light_.clipFromWorld)};
    const auto screen = [&](std::string_view pass, glm::ivec2 size, const Taps& taps) {
        passes.push_back({.pass = pass, .source = source, .size = size, .targets = {format}, .taps = {taps}});
    };
    const bool drawnAtOnce = stored_.layers() == 1; // the casters write it
    if (drawnAtOnce) passes[0].targets.insert(passes[0].targets.begin(), format);
    std::vector<Taps> reads;
    for (int layer = 0; layer < stored_.layers(); ++layer) {
        if (!drawnAtOnce) screen("basis", side, {gl::Format::Depth32F, side, Read::Pixel});
        for (int axis = 0; axis < 2; ++axis) screen("blur", filteredSide, {format, filteredSide, Read::Nearest, width});
        // All smaller levels together have a third of the texels, each the mean of four.
        screen("blur", {filteredSide.x / 2, 2 * filteredSide.y / 3}, {format, filteredSide, Read::Linear});
        reads.push_back({format, filteredSide, Read::Linear});
    }
    passes.push_back(bareLookup("resolve", source, frame.size, std::move(reads)));
    return passes;
}

void PrefilteredMap::bindTo(gl::Program& resolve, const Frame& frame) const {
    resolve.set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("mapFromWorld", mapFromWorld(light_))
        .set("imageFromWorld", glm::mat4(imageFromClip(frame.size) * frame.clipFromWorld))
        .set("unitDepthFromWorld", glm::vec4(unitDepthFromWorld(light_)))
        .set("maps", filtered_);
}

void PrefilteredMap::bindDepthsTo(gl::Program& resolve) const {
    resolve.set("linearDepth", depth_.texture())
        .set("depthRange", glm::vec2(light_.near, light_.far))
        .set("level", box_.level)
        .set("width", static_cast<float>(box_.width));
}

} // namespace shadowbench::techniques
