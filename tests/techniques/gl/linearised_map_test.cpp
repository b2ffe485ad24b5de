// Depth-only maps read as linear depth: the closed form, and how much of it 32-bit floats keep.
#include "techniques/shared/maps/linearised_map.h"

#include "techniques/shared/maps/linear_depth_map.h"
#include "tests/support/shader_function.h"
#include "tests/support/soft_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using techniques::depthStep;
using techniques::LightView;

constexpr double defaultBias = 64 * depthStep; // of the far distance

LightView viewOver(double near, double far, bool perspective) {
    LightView view;
    view.near = near;
    view.far = far;
    view.perspective = perspective;
    return view;
}

/// What the shader makes of these window depths.
std::vector<double> linearDepths(const LightView& view, const std::vector<double>& windows, double bias = 0) {
    std::vector<glm::vec4> inputs;
    for (const double z : windows) inputs.emplace_back(static_cast<float>(z));
    const auto results =
        evaluated("shared/maps/linearised_map.glsl", "linearDepth(x.x)", inputs, {},
                  [&](gl::Program& program) { program.set("linearisation", techniques::linearisation(view, bias)); });
    std::vector<double> depths;
    for (const glm::vec4& result : results) depths.push_back(result.x);
    return depths;
}

TEST(LinearisedMap, DepthIsLinearAgainWithinWhatStoringLost) {
    for (const double share : {0.5, 0.1, 0.01}) { // the last is the nearest near plane that a view is fitted with
        const double far = 37, near = share * far;
        std::vector<double> depths, windows;
        for (int i = 0; i < 1000; ++i) {
            depths.push_back(near + (far - near) * (i + 0.5) / 1000);
            windows.push_back(far / (far - near) * (1 - near / depths.back()));
        }
        const auto linear = linearDepths(viewOver(near, far, true), windows);
        for (std::size_t i = 0; i < depths.size(); ++i) {
            const double d = depths[i];
            const double stored = d * d * (far - near) / (near * far) * 0.5 * depthStep;
            const double computed = 4 * depthStep * d; // a division and two products
            ASSERT_NEAR(linear[i], d, stored + computed) << share;
            ASSERT_LT(stored, defaultBias * far);
        }
    }
}

TEST(LinearisedMap, ADirectionalLightsDepthIsItsDistance) {
    const auto linear = linearDepths(viewOver(-3, 5, false), {0, 0.25, 0.75}, 0.125);
    EXPECT_NEAR(linear[0], -2.875, 1e-6);
    EXPECT_NEAR(linear[1], -0.875, 1e-6);
    EXPECT_NEAR(linear[2], 3.125, 1e-6);
}

TEST(LinearisedMap, WhereNothingIsInTheWayNothingBlocks) {
    EXPECT_EQ(linearDepths(viewOver(1, 2, true), {1}).front(), gl::nothingInTheWay);
    EXPECT_EQ(linearDepths(viewOver(1, 2, false), {1}).front(), gl::nothingInTheWay);
}

/// Linear depths of a map's texels, row 0 at the top.
Image<float> linearised(const techniques::LinearisedMap& map) {
    const gl::Texture depths(gl::Format::R32F, {map.side(), map.side()});
    gl::Program program =
        gl::Program::screenFromText("linear depths of texels", "#include \"shared/maps/linearised_map.glsl\"\n"
                                                               "out float depth;\n"
                                                               "void main() {\n"
                                                               "    vec2 size = vec2(textureSize(windowDepths, 0));\n"
                                                               "    depth = linearDepthAt(gl_FragCoord.xy / size);\n}\n");
    map.bindTo(program);
    const gl::RenderTarget target({&depths});
    target.bind();
    program.drawScreen();
    return target.readFloat(0);
}

/// How far the depths of a depth-only map are from those that shaders compute and store, in the default constant bias: of
/// all but a hundredth of the texels. Sides that are seen edge-on are steeper within a texel than either can hold.
double differenceOverBias(double lightHeight, techniques::Bias bias) {
    Scene scene = halfPlaneScene();
    scene.light.centre.y = lightHeight;
    Stage stage(scene);
    stage.show(0);
    const techniques::Frame frame = stage.frame(0, 1);
    const LightView view = techniques::fitToScene(scene.light, frame.snapshot);
    constexpr int side = 256;
    techniques::LinearisedMap read(side, bias);
    techniques::LinearDepthMap written(side, bias);
    read.draw(view, frame);
    written.draw(view, frame);
    const Image<float> one = linearised(read), other = gl::RenderTarget({&written.texture()}).readFloat(0);
    std::vector<double> differences;
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (one[i] == gl::nothingInTheWay || other[i] == gl::nothingInTheWay) continue;
        differences.push_back(std::abs(static_cast<double>(one[i]) - static_cast<double>(other[i])));
    }
    EXPECT_GT(differences.size(), one.size() / 4);
    std::sort(differences.begin(), differences.end());
    return differences[differences.size() * 99 / 100] / (defaultBias * view.far);
}

TEST(LinearisedMap, HoldsTheDepthsThatShadersComputeWithinTheConstantBias) {
    EXPECT_LT(differenceOverBias(6, {}), 0.25);
    EXPECT_LT(differenceOverBias(2.05, {}), 1); // the near plane is held at a hundredth of the far distance
    EXPECT_LT(differenceOverBias(6, {0, 64}), 0.25);
}

} // namespace
} // namespace shadowbench
