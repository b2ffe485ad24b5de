// Clustered principal component analysis: vector quantisation, then principal components within each cluster (course,
// "Reducing Storage Cost", VQ + PCA).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Vector i ≈ mean of its cluster + Σ weight · component, in the order of the components' importance.
struct ClusteredVectors {
    std::size_t dimensions = 0, components = 0;
    std::vector<std::uint32_t> cluster; // of each vector
    std::vector<float> weights;         // component by component, each of all vectors
    std::vector<float> bases;           // cluster by cluster: its mean, then its components, `dimensions` numbers each
    double rmsError = 0;                // of the coefficients

    [[nodiscard]] std::size_t clusters() const { return bases.size() / ((components + 1) * dimensions); }
    [[nodiscard]] std::size_t bytes() const;
};

/// `vectors` hold `dimensions` numbers each, one vector after the other; there is one at least. At most `clusters` ≥ 1
/// clusters and `dimensions` components.
ClusteredVectors clusteredPca(std::span<const float> vectors, std::size_t dimensions, std::size_t clusters,
                              std::size_t components);

} // namespace shadowbench::techniques
