// Clustered principal component analysis of vectors whose clusters and components are known.
#include "techniques/environment/prt-sh/clustered_pca.h"

#include "base/random.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t dimensions = 5, count = 400;

/// Two clusters, far apart, each of points on a plane of its own.
std::vector<float> twoPlanes() {
    Random random(7);
    std::vector<float> vectors;
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = static_cast<float>(random.uniform(-1, 1)), b = static_cast<float>(random.uniform(-0.3, 0.3));
        if (i % 2 == 0)
            vectors.insert(vectors.end(), {10 + a, b, a, 0, 1});
        else
            vectors.insert(vectors.end(), {-10, a, b - a, 2 * b, 0});
    }
    return vectors;
}

float approximated(const ClusteredVectors& compressed, std::size_t vector, std::size_t dimension) {
    const float* basis = &compressed.bases[compressed.cluster[vector] * (compressed.components + 1) * dimensions];
    float value = basis[dimension];
    for (std::size_t k = 0; k < compressed.components; ++k)
        value += compressed.weights[k * compressed.cluster.size() + vector] * basis[(k + 1) * dimensions + dimension];
    return value;
}

double rmsError(const std::vector<float>& vectors, const ClusteredVectors& compressed) {
    double sum = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i)
        sum += std::pow(static_cast<double>(vectors[i] - approximated(compressed, i / dimensions, i % dimensions)), 2);
    return std::sqrt(sum / static_cast<double>(vectors.size()));
}

TEST(ClusteredPca, FindsTheClusters) {
    const ClusteredVectors compressed = clusteredPca(twoPlanes(), dimensions, 2, 1);
    EXPECT_EQ(compressed.clusters(), 2U);
    EXPECT_NE(compressed.cluster[0], compressed.cluster[1]);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(compressed.cluster[i], compressed.cluster[i % 2]);
}

TEST(ClusteredPca, IsExactWithAsManyComponentsAsTheClustersSpan) {
    const std::vector<float> vectors = twoPlanes();
    const ClusteredVectors compressed = clusteredPca(vectors, dimensions, 2, 2);
    EXPECT_LT(compressed.rmsError, 1e-5);
    EXPECT_NEAR(rmsError(vectors, compressed), 0, 1e-5);
}

TEST(ClusteredPca, ReportsItsError) {
    const std::vector<float> vectors = twoPlanes();
    const ClusteredVectors one = clusteredPca(vectors, dimensions, 2, 1);
    EXPECT_GT(one.rmsError, 0.01);
    EXPECT_NEAR(rmsError(vectors, one), one.rmsError, 1e-5);
    // The first component is the direction of the greatest spread: the rest is the narrow one's, at most 0.3/√3 · √5 long.
    EXPECT_LT(one.rmsError, 0.3 / std::sqrt(3.0) * std::sqrt(5.0) / std::sqrt(5.0));
    EXPECT_GT(clusteredPca(vectors, dimensions, 1, 1).rmsError, one.rmsError);
}

TEST(ClusteredPca, OfEqualVectorsIsTheirMean) {
    const std::vector<float> vectors(3 * dimensions, 2.5F);
    const ClusteredVectors compressed = clusteredPca(vectors, dimensions, 8, 3);
    EXPECT_EQ(compressed.clusters(), 1U);
    EXPECT_EQ(compressed.rmsError, 0);
    for (const float weight : compressed.weights) EXPECT_EQ(weight, 0);
}

TEST(ClusteredPca, CountsItsBytes) {
    const ClusteredVectors compressed = clusteredPca(twoPlanes(), dimensions, 2, 2);
    EXPECT_EQ(compressed.bytes(), 4 * (count + 2 * count + 2 * 3 * dimensions));
}

} // namespace
} // namespace shadowbench::techniques
