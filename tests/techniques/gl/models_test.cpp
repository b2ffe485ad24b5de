// The functions that shaders compute, each against its model of the same name (tests/support/models), over a grid of inputs.
#include "techniques/filtered/deep-sm/deep_texture.h"
#include "tests/support/models/deep_sm.h"
#include "tests/support/models/esm.h"
#include "tests/support/models/lvsm.h"
#include "tests/support/models/sm_history.h"
#include "tests/support/models/temporal_soft.h"
#include "tests/support/models/vsm.h"
#include "tests/support/shader_function.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace models;

constexpr double single = 2e-6;         // a few roundings of 32-bit floats near 1
constexpr double transcendental = 1e-4; // what llvmpipe's exp2 and log2 leave, raised to a power

/// Every combination of one value of each list.
std::vector<glm::vec4> grid(const std::vector<float>& xs, const std::vector<float>& ys = {0},
                            const std::vector<float>& zs = {0}, const std::vector<float>& ws = {0}) {
    std::vector<glm::vec4> inputs;
    for (const float x : xs)
        for (const float y : ys)
            for (const float z : zs)
                for (const float w : ws) inputs.emplace_back(x, y, z, w);
    return inputs;
}

template <typename Model>
void expectEqual(const std::vector<glm::vec4>& inputs, const std::vector<glm::vec4>& results, double tolerance,
                 const Model& model) {
    ASSERT_EQ(results.size(), inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::vec4& x = inputs[i];
        EXPECT_NEAR(results[i].x, model(x), tolerance) << x.x << " " << x.y << " " << x.z << " " << x.w;
    }
}

TEST(SmHistoryShader, ConfidenceFallsFromATexelsCentreToItsBorder) {
    const auto inputs = grid({-1.3F, 0, 0.25F, 0.5F, 7.4F, 30.9F}, {-0.7F, 0.5F, 0.75F, 3.01F, 63.5F});
    expectEqual(inputs, evaluated("maps/sm-history/history.glsl", "confidence(x.xy)", inputs), 1e-5, [](const glm::vec4& x) {
        return confidence({x.x, x.y});
    });
}

TEST(SmHistoryShader, SmoothedWeighsThisFrameByItsConfidence) {
    const auto inputs = grid({0, 0.4F, 1}, {0, 0.3F, 1}, {0.01F, 0.25F, 0.5F, 1}, {0.5F, 3, 15});
    expectEqual(inputs, evaluated("maps/sm-history/history.glsl", "smoothed(x.x, x.y, x.z, x.w)", inputs), transcendental,
                [](const glm::vec4& x) { return smoothed(x.x, x.y, x.z, x.w); });
}

/// ρ, n and τ.
std::vector<glm::vec4> samplings() {
    std::vector<glm::vec4> inputs;
    for (int n = 1; n < 40; n += 3)
        for (int shadowed = 0; shadowed <= n; ++shadowed)
            for (const float tau : {0.0F, 1.0F}) inputs.emplace_back(shadowed, n, tau, 0);
    return inputs;
}

const std::string estimators = "sampled/estimators.glsl";

TEST(TemporalSoftShader, EstimatesTheOccludedFraction) { // eq. 4.2
    const auto inputs = samplings();
    expectEqual(inputs, evaluated(estimators, "occlusionEstimate(x.x, x.y)", inputs), single,
                [](const glm::vec4& x) { return occlusionEstimate(x.x, x.y); });
}

TEST(TemporalSoftShader, TakesInOneMoreSample) { // eq. 4.5
    const auto inputs = samplings();
    const std::string updated = "occlusionEstimate(withSample(x.xy, x.z).x, withSample(x.xy, x.z).y)";
    expectEqual(inputs, evaluated(estimators, updated, inputs), single,
                [](const glm::vec4& x) { return occlusionUpdate(x.x, x.y, x.z); });
}

TEST(TemporalSoftShader, EstimatesTheVariance) { // eq. 4.3
    const auto inputs = samplings();
    expectEqual(inputs, evaluated(estimators, "occlusionVariance(x.x / x.y, x.y)", inputs), single,
                [](const glm::vec4& x) { return occlusionVariance(static_cast<double>(x.x) / x.y, x.y); });
}

TEST(TemporalSoftShader, KeepsTheMeanBlockerDepth) { // eq. 4.7
    const auto inputs = grid({0.5F, 4, 9.5F}, {0.25F, 6, 8}, {1, 2, 17, 1000}, {1, 16});
    expectEqual(inputs, evaluated(estimators, "blockerUpdate(x.x, x.y, x.z, x.w)", inputs), 10 * single,
                [](const glm::vec4& x) { return blockerUpdate(x.x, x.y, x.z, x.w); });
}

TEST(VsmShader, BoundsTheShareByChebyshevsInequality) {
    // Mean and variance of two depths, a share of the kernel each.
    std::vector<glm::vec4> inputs;
    for (const float share : {0.0F, 0.1F, 0.5F, 0.97F})
        for (const float depth : {0.05F, 0.3F, 0.55F, 0.8F, 1.0F})
            for (const float least : {1e-6F, 1e-2F}) {
                const float low = 0.25F, high = 0.75F; // exact, and so are their squares
                inputs.emplace_back((1 - share) * low + share * high, (1 - share) * low * low + share * high * high, depth,
                                    least);
            }
    expectEqual(inputs, evaluated("filtered/moments.glsl", "chebyshevBound(x.xy, x.z, x.w)", inputs), 2e-5,
                [](const glm::vec4& x) {
                    return chebyshevBound({x.x, x.y}, x.z, x.w);
                });
}

TEST(VsmShader, CutsOffBleeding) {
    const auto inputs = grid({0, 0.2F, 0.3F, 0.65F, 1}, {0, 0.3F, 0.9F});
    expectEqual(inputs, evaluated("filtered/moments.glsl", "withoutBleeding(x.x, x.y)", inputs), 10 * single,
                [](const glm::vec4& x) { return withoutBleeding(x.x, x.y); });
}

const std::string exponential = "filtered/esm/exponential.glsl";

TEST(EsmShader, TestsTheMeanOfExponentials) {
    std::vector<glm::vec4> inputs;
    for (const float c : {5.0F, 20.0F, 80.0F})
        for (const float occluder : {0.1F, 0.4F, 0.7F})
            for (const float receiver : {0.2F, 0.41F, 0.5F, 0.9F})
                inputs.emplace_back(receiver, std::exp(c * occluder), c, 0);
    expectEqual(inputs, evaluated(exponential, "exponentialTest(meanTest(x.x, x.y, x.z))", inputs), transcendental,
                [](const glm::vec4& x) { return exponentialTest(x.x, x.y, x.z); });
}

TEST(EsmShader, ReachesAVisibilityAtTheModelsDistance) {
    std::vector<glm::vec4> inputs;
    std::vector<double> expected;
    for (const double visibility : {0.02, 0.1, 0.5, 0.9}) {
        constexpr double c = 80, occluder = 0.4;
        inputs.emplace_back(occluder + exponentialReach(visibility, c), std::exp(c * occluder), c, 0);
        expected.push_back(visibility);
    }
    const auto results = evaluated(exponential, "exponentialTest(meanTest(x.x, x.y, x.z))", inputs);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(results[i].x, expected[i], transcendental);
}

TEST(LvsmShader, StoresDepthByLayer) {
    for (const int count : {1, 2, 5}) {
        std::vector<float> layers;
        for (int i = 0; i < count; ++i) layers.push_back(static_cast<float>(i));
        const auto inputs = grid({0, 0.1F, 0.37F, 0.5F, 0.81F, 0.99F, 1}, layers);
        const gl::Defines defines{{"LAYERS", std::to_string(count)}};
        const auto overlapped = [](gl::Program& program) { program.set("overlap", 0.2F); };
        if (count > 1)
            expectEqual(inputs,
                        evaluated("filtered/lvsm/layers.glsl", "layerDepth(x.x, int(x.y))", inputs, defines, overlapped),
                        5 * single,
                        [&](const glm::vec4& x) { return layerDepth(depthLayer(static_cast<int>(x.y), count, 0.2F), x.x); });
        expectEqual(inputs, evaluated("filtered/lvsm/layers.glsl", "float(layerOf(x.x))", inputs, defines), 0,
                    [&](const glm::vec4& x) { return layerOf(static_cast<double>(x.x), count); });
    }
}

TEST(DeepSmShader, FollowsEachTexelsFunction) {
    const techniques::Transmittance lit{}, step{{0.5F, 1}, {0.5F, 0.25F}},
        ramp{{0.25F, 1}, {0.5F, 0.5F}, {0.5F, 0.25F}, {1, 0}}, dark{{0.125F, 1}, {0.125F, 0}};
    techniques::DeepTexture deep; // two by two texels
    for (const auto& function : {lit, step, ramp, dark}) {
        deep.first.push_back(static_cast<std::uint32_t>(deep.nodes.size()));
        deep.nodes.insert(deep.nodes.end(), function.begin(), function.end());
    }
    deep.first.push_back(static_cast<std::uint32_t>(deep.nodes.size()));
    testContext();
    gl::Buffer firsts, nodes;
    firsts.upload(deep.first.data(), deep.first.size() * sizeof(deep.first.front()));
    nodes.upload(deep.nodes.data(), deep.nodes.size() * sizeof(deep.nodes.front()));

    const auto inputs = grid({0, 1}, {0, 1}, {0, 0.125F, 0.126F, 0.3F, 0.5F, 0.501F, 0.75F, 1});
    const auto results = evaluated("filtered/deep-sm/transmittance.glsl", "transmittanceAt(ivec2(x.xy), x.z)", inputs, {},
                                   [&](gl::Program& program) {
                                       program.set("side", 2);
                                       firsts.bindStorage(0);
                                       nodes.bindStorage(1);
                                   });
    const std::vector<techniques::Transmittance> functions{lit, step, ramp, dark};
    expectEqual(inputs, results, single, [&](const glm::vec4& x) {
        return transmittanceAt(functions[static_cast<std::size_t>(x.x + 2 * x.y)], x.z);
    });
}

} // namespace
} // namespace shadowbench
