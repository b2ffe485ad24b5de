#include "techniques/filtered/prefiltered_map.h"

#include "base/error.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/shared/maps/single_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {
namespace {

constexpr int widest = 8;       // texels of a box that are read one by one
constexpr std::size_t run = 16; // texels of a column that an invocation of filtered/columns.comp writes

/// Texels of a row that an invocation of filtered/rows.glsl writes: of several textures fewer, for it holds all of them.
std::size_t rowRun(std::size_t textures) { return textures > 1 ? 8 : 16; }

/// The view with `rim` texels of `side` left free on every side of the map.
LightView withFreeRim(LightView view, int rim, int side) {
    const double share = std::max(1 - 2.0 * rim / side, 0.5);
    view.clipFromWorld = glm::scale(glm::dmat4(1), glm::dvec3(share, share, 1)) * view.clipFromWorld;
    return view;
}

/// The view with depth counted from its near plane on: a directional light's own has no origin.
LightView withDepthFromNear(LightView view) {
    if (view.perspective) return view;
    view.depthFromWorld.w -= view.near;
    view.far -= view.near;
    view.near = 0;
    return view;
}

/// Numbers that a texel of the format holds.
int numbersOf(gl::Format format) {
    if (format == gl::Format::R32F) return 1;
    return format == gl::Format::RG32F ? 2 : 4;
}

/// Texels that the first of the box's passes writes into one of four numbers.
int packed(const Basis& basis) { return 4 / numbersOf(basis.format); }

/// Textures that one draw writes.
int texturesAtOnce(const Basis& basis) {
    for (const int count : {8, 4, 2})
        if (basis.textures % count == 0) return count;
    return 1;
}

gl::Defines boxDefines(const BoxFilter& box, const Basis& basis) {
    int reach = 0;
    while (boxWeight(box.width, reach + 1) > 0) ++reach;
    return {{"WIDTH", std::to_string(box.width)}, {"REACH", std::to_string(reach)}, {"PACK", std::to_string(packed(basis))}};
}

/// A format as shaders and GL name it where texels are stored into.
struct ImageFormat {
    std::string name;
    GLenum internal;
};

ImageFormat imageFormat(gl::Format format) {
    switch (format) {
    case gl::Format::RGBA8:
        return {"rgba8", GL_RGBA8};
    case gl::Format::R32F:
        return {"r32f", GL_R32F};
    case gl::Format::RG32F:
        return {"rg32f", GL_RG32F};
    case gl::Format::RGBA32F:
        return {"rgba32f", GL_RGBA32F};
    default:
        throw InternalError("a prefiltered map cannot be stored in this format");
    }
}

/// Of the means along rows.
gl::Format rowFormat(const Basis& basis) {
    return basis.format == gl::Format::RGBA8 ? gl::Format::RGBA8 : gl::Format::RGBA32F;
}

/// The first of the box's two passes.
gl::Program rowsPass(const BoxFilter& box, const Basis& basis, std::size_t textures) {
    gl::Defines defines = boxDefines(box, basis);
    defines.emplace_back("LEVEL", std::to_string(box.level));
    defines.emplace_back("TEXTURES", std::to_string(textures));
    defines.emplace_back("RUN", std::to_string(rowRun(textures)));
    defines.emplace_back("FORMAT", imageFormat(rowFormat(basis)).name);
    defines.insert(defines.end(), basis.defines.begin(), basis.defines.end());
    return gl::Program::compute(basis.file, defines);
}

/// The second one.
gl::Program columnsPass(const BoxFilter& box, const Basis& basis) {
    gl::Defines defines = boxDefines(box, basis);
    defines.emplace_back("FORMAT", imageFormat(basis.format).name);
    return gl::Program::compute("filtered/columns.comp", defines);
}

std::vector<gl::Texture> rowTextures(const Basis& basis, glm::ivec2 size) {
    const int pack = packed(basis);
    std::vector<gl::Texture> rows;
    for (int i = 0; i < texturesAtOnce(basis); ++i)
        rows.emplace_back(rowFormat(basis), glm::ivec2((size.x + pack - 1) / pack, size.y));
    return rows;
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
      format_(basis.format), filtered_(basis.format, glm::ivec2(sideAt(box_.level, depth_.side())), basis.textures),
      rows_(rowTextures(basis, filtered_.size())), rowMeans_(rowsPass(box_, basis, rows_.size())),
      means_(columnsPass(box_, basis)) {}

void PrefilteredMap::draw(const Frame& frame) {
    light_ = withFreeRim(withDepthFromNear(uniformView(frame)), freeRim(box_), depth_.side());
    depth_.draw(light_, frame);
    const auto pass = frame.pass("blur");
    depth_.bindUnitTo(rowMeans_);
    const auto atOnce = static_cast<int>(rows_.size());
    for (int first = 0; first < filtered_.layers(); first += atOnce) {
        blurRows(first);
        for (int i = 0; i < atOnce; ++i) blurColumns(rows_[static_cast<std::size_t>(i)], first + i);
    }
    filtered_.makeMipmaps();
}

void PrefilteredMap::blurRows(int firstTexture) {
    if (rowMeans_.uses("firstTexture")) rowMeans_.set("firstTexture", firstTexture);
    const GLenum format = imageFormat(rows_.front().format()).internal;
    for (std::size_t i = 0; i < rows_.size(); ++i)
        glBindImageTexture(static_cast<GLuint>(i), rows_[i].id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
    const glm::ivec2 means = rows_.front().size() * glm::ivec2(4 / numbersOf(format_), 1);
    const std::size_t length = rowRun(rows_.size()), runs = (static_cast<std::size_t>(means.x) + length - 1) / length;
    rowMeans_.dispatch(runs * static_cast<std::size_t>(means.y));
}

void PrefilteredMap::blurColumns(const gl::Texture& rows, int layer) {
    means_.set("rows", rows);
    glBindImageTexture(0, filtered_.id(), 0, GL_FALSE, layer, GL_WRITE_ONLY, imageFormat(format_).internal);
    const std::size_t runs = (static_cast<std::size_t>(rows.size().y) + run - 1) / run;
    means_.dispatch(static_cast<std::size_t>(rows.size().x) * runs);
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
    depth_.bindUnitTo(resolve);
    resolve.set("level", box_.level).set("width", static_cast<float>(box_.width));
}

} // namespace shadowbench::techniques
