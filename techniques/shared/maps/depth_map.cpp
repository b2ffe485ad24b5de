#include "techniques/shared/maps/depth_map.h"

#include "techniques/gl/api.h"
#include "techniques/gl/counters.h"

#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {
namespace {

constexpr float rasterStep = 1.0F / 256; // shared/maps/caster_depth.glsl

} // namespace

Parameter mapParameter(int defaultSide) {
    return {"map", std::to_string(defaultSide), IntegerRange{16, 8192}, "texels per side of the shadow map",
            "EGSR paper, 4"};
}

std::vector<Parameter> depthMapParameters(int defaultSide) {
    return {
        mapParameter(defaultSide),
        {"bias", "slope", OneOf{{"none", "constant", "slope"}}, "depth bias while the map is drawn", "course, Bias"},
        // A texel in x and in y changes depth by at most |∂z/∂x| + |∂z/∂y| ≤ 2 · max slope (docs/techniques.md, "Bias").
        {"factor", "2", RealRange{0, 64}, "of the polygon's depth slope per texel (bias=slope)",
         "OpenGL Programming Guide, 8th ed., p. 404"},
        {"units", "64", RealRange{0, 1e7}, "constant bias in 2⁻²⁴ of the depth range (all but bias=none): covers rounding",
         ""},
    };
}

std::vector<Parameter> withDepthMapParameters(std::vector<Parameter> own) {
    for (Parameter& parameter : depthMapParameters()) own.push_back(std::move(parameter));
    return own;
}

std::vector<Parameter> withNormalOffset(std::vector<Parameter> parameters) {
    for (Parameter& parameter : parameters) {
        if (parameter.name == "bias") {
            parameter.domain = OneOf{{"none", "constant", "slope", "normal-offset"}};
            parameter.meaning = "of depths while the map is drawn, or of receivers along their normals (Holbert 2011)";
        }
        if (parameter.name == "factor")
            parameter.meaning = "of the polygon's depth slope per texel (bias=slope), or of half a texel's width times the "
                                "sine between normal and light (normal-offset)";
    }
    return parameters;
}

Bias biasFrom(const Parameters& parameters) {
    const std::string& kind = parameters.text("bias");
    if (kind == "none") return {};
    const auto units = static_cast<float>(parameters.real("units"));
    if (kind == "constant") return {.units = units};
    const auto factor = static_cast<float>(parameters.real("factor"));
    if (kind == "normal-offset") return {.units = units, .normalOffset = factor};
    return {.factor = factor, .units = units};
}

bool followsPlane(const Parameters& parameters) {
    const std::string& kind = parameters.text("bias");
    return kind == "slope" || kind == "normal-offset";
}

CasterState::CasterState(Bias bias) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(bias.factor + 2 * rasterStep, 0); // a step along x and one along y, by the greater slope
}

CasterState::~CasterState() {
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
}

CasterPass::CasterPass(gl::Program& program, const LightView& light, Bias bias) : state_(bias) {
    if (light.perspective) glEnable(GL_CLIP_DISTANCE0);
    // The constant part goes into the matrix: polygon offset's unit of a floating-point depth buffer vanishes near depth 0.
    const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 2 * bias.units * depthStep));
    program.set("clipFromWorld", glm::mat4(away * light.clipFromWorld));
    // Nothing casts from behind the light or from closer to its plane than a ten-thousandth of the scene's depth. Nothing is
    // behind a directional light; llvmpipe clips by a written gl_ClipDistance even where it is disabled, so that the
    // distance must be positive there.
    const glm::dvec4 inFront = light.depthFromWorld - glm::dvec4(0, 0, 0, 1e-4 * light.far);
    program.set("lightPlane", glm::vec4(light.perspective ? inFront : glm::dvec4(0, 0, 0, 1)));
    if (program.uses("casterPlane")) {
        glEnable(GL_CLIP_DISTANCE1);
        program.set("casterPlane", glm::vec4(light.casterPlane));
    }
    program.use();
}

CasterPass::~CasterPass() {
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_CLIP_DISTANCE1);
}

DepthMap::DepthMap(int side, Bias bias, Lookup lookup, bool cutsCasters)
    : depth_(gl::Format::Depth32F, {side, side},
             lookup == Lookup::CompareBilinear ? gl::Filter::Linear : gl::Filter::Nearest, gl::Wrap::BorderFar),
      target_{&depth_}, cutsCasters_(cutsCasters), program_(program(cutsCasters)), bias_(bias) {
    if (lookup != Lookup::Raw) depth_.compareDepth();
}

gl::Program DepthMap::program(bool cutsCasters) {
    return {"shared/maps/depth_map.vert", "gl/depth_only.frag",
            cutsCasters ? gl::Defines{{"CASTER_PLANE", "1"}} : gl::Defines{}};
}

CasterFragments DepthMap::fragments(const LightView& light, const Frame& frame) const {
    gl::Program again = program(cutsCasters_);
    const auto drawn = [&](GLenum depthFunction, GLboolean write) {
        target_.bind();
        const CasterPass pass(again, light, bias_);
        glDepthFunc(depthFunction);
        glDepthMask(write);
        gl::FragmentMeter meter;
        frame.scene.draw();
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
        return meter.finish();
    };
    CasterFragments count;
    count.rasterised = drawn(GL_ALWAYS, GL_FALSE);
    target_.clearDepth(1);
    count.written = drawn(GL_LESS, GL_TRUE);
    return count;
}

void DepthMap::draw(const LightView& light, const Frame& frame) {
    const auto pass = frame.pass("depth map");
    target_.clearDepth(1);
    target_.bind();
    const CasterPass casters(program_, light, bias_);
    frame.scene.draw();
}

glm::dmat4 mapFromClip() { return glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(1)); }

glm::mat4 mapFromWorld(const LightView& light) { return glm::mat4(mapFromClip() * light.clipFromWorld); }

} // namespace shadowbench::techniques
