#include "techniques/environment/prt-sh/clustered_pca.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace shadowbench::techniques {
namespace {

/// Vectors one after the other.
struct VectorList {
    std::span<const float> values;
    std::size_t dimensions;

    [[nodiscard]] std::size_t size() const { return values.size() / dimensions; }
    [[nodiscard]] std::span<const float> operator[](std::size_t i) const {
        return values.subspan(i * dimensions, dimensions);
    }
};

float squaredDistance(std::span<const float> a, std::span<const float> b) {
    float sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// The first vectors of clusters, each drawn with a probability that grows with its squared distance from those before
/// (Arthur and Vassilvitskii 2007, k-means++). Fewer where fewer differ.
std::vector<float> firstMeans(const VectorList& vectors, std::size_t clusters) {
    Random random(1);
    std::vector<float> means;
    std::vector<float> distances(vectors.size(), std::numeric_limits<float>::max());
    for (std::size_t chosen = 0; means.size() < clusters * vectors.dimensions;) {
        const auto mean = vectors[chosen];
        means.insert(means.end(), mean.begin(), mean.end());
        double sum = 0;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            distances[i] = std::min(distances[i], squaredDistance(vectors[i], mean));
            sum += static_cast<double>(distances[i]);
        }
        if (sum == 0) break;
        double left = random.uniform() * sum;
        chosen = 0;
        while (chosen + 1 < vectors.size() && (left -= static_cast<double>(distances[chosen])) > 0) ++chosen;
    }
    return means;
}

void assign(const VectorList& vectors, const VectorList& means, std::vector<std::uint32_t>& cluster) {
    inParallelParts(vectors.size(), availableThreads(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            float least = std::numeric_limits<float>::max();
            for (std::size_t k = 0; k < means.size(); ++k) {
                const float distance = squaredDistance(vectors[i], means[k]);
                if (distance >= least) continue;
                least = distance;
                cluster[i] = static_cast<std::uint32_t>(k);
            }
        }
    });
}

/// Each cluster's mean; a cluster without vectors keeps its own.
void moveMeans(const VectorList& vectors, const std::vector<std::uint32_t>& cluster, std::vector<float>& means) {
    std::vector<double> sums(means.size());
    std::vector<std::size_t> counts(means.size() / vectors.dimensions);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        ++counts[cluster[i]];
        for (std::size_t d = 0; d < vectors.dimensions; ++d)
            sums[cluster[i] * vectors.dimensions + d] += static_cast<double>(vectors[i][d]);
    }
    for (std::size_t i = 0; i < means.size(); ++i)
        if (const std::size_t count = counts[i / vectors.dimensions]; count > 0)
            means[i] = static_cast<float>(sums[i] / static_cast<double>(count));
}

/// A symmetric matrix, row by row.
using Matrix = std::vector<double>;

Matrix covariance(const VectorList& vectors, const std::vector<std::size_t>& members, std::span<const float> mean) {
    const std::size_t n = vectors.dimensions;
    Matrix sums(n * n);
    for (const std::size_t member : members)
        for (std::size_t i = 0; i < n; ++i) {
            const double difference = static_cast<double>(vectors[member][i] - mean[i]);
            for (std::size_t j = 0; j < n; ++j)
                sums[i * n + j] += difference * static_cast<double>(vectors[member][j] - mean[j]);
        }
    return sums;
}

struct Rotation {
    std::size_t p, q;
    double cosine, sine;
};

/// The turn in the plane of rows p and q that makes their element 0 (Golub and Van Loan, Jacobi's method).
Rotation annihilating(const Matrix& m, std::size_t n, std::size_t p, std::size_t q) {
    const double theta = (m[q * n + q] - m[p * n + p]) / (2 * m[p * n + q]);
    const double tangent = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double cosine = 1 / std::sqrt(tangent * tangent + 1);
    return {p, q, cosine, tangent * cosine};
}

void turnRows(Matrix& m, std::size_t n, const Rotation& r) {
    for (std::size_t k = 0; k < n; ++k) {
        const double p = m[r.p * n + k], q = m[r.q * n + k];
        m[r.p * n + k] = r.cosine * p - r.sine * q;
        m[r.q * n + k] = r.sine * p + r.cosine * q;
    }
}

void turnColumns(Matrix& m, std::size_t n, const Rotation& r) {
    for (std::size_t k = 0; k < n; ++k) {
        const double p = m[k * n + r.p], q = m[k * n + r.q];
        m[k * n + r.p] = r.cosine * p - r.sine * q;
        m[k * n + r.q] = r.sine * p + r.cosine * q;
    }
}

/// Unit eigenvectors as rows, by falling eigenvalue.
Matrix eigenvectors(Matrix m, std::size_t n) {
    constexpr int sweeps = 12; // convergence is quadratic
    Matrix vectors(n * n);
    for (std::size_t i = 0; i < n; ++i) vectors[i * n + i] = 1;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (m[p * n + q] == 0) continue;
                const Rotation rotation = annihilating(m, n, p, q);
                turnRows(m, n, rotation);
                turnColumns(m, n, rotation);
                turnRows(vectors, n, rotation);
            }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return m[i * n + i]; });
    Matrix sorted;
    for (const std::size_t i : order) sorted.insert(sorted.end(), &vectors[i * n], &vectors[i * n] + n);
    return sorted;
}

/// Writes mean and components of one cluster, its members' weights, and returns the sum of their squared errors.
double fitCluster(const VectorList& vectors, const std::vector<std::size_t>& members, std::span<const float> mean,
                  std::size_t cluster, ClusteredVectors& result) {
    const std::size_t n = vectors.dimensions, count = vectors.size();
    float* const basis = &result.bases[cluster * (result.components + 1) * n];
    std::ranges::copy(mean, basis);
    const Matrix components = eigenvectors(covariance(vectors, members, mean), n);
    std::transform(components.begin(), components.begin() + static_cast<std::ptrdiff_t>(result.components * n), basis + n,
                   [](double x) { return static_cast<float>(x); });
    double error = 0;
    std::vector<double> rest(n);
    for (const std::size_t member : members) {
        for (std::size_t d = 0; d < n; ++d) rest[d] = static_cast<double>(vectors[member][d] - mean[d]);
        for (std::size_t k = 0; k < result.components; ++k) {
            const double weight = std::inner_product(rest.begin(), rest.end(), &components[k * n], 0.0);
            result.weights[k * count + member] = static_cast<float>(weight);
            for (std::size_t d = 0; d < n; ++d) rest[d] -= weight * components[k * n + d];
        }
        error += std::inner_product(rest.begin(), rest.end(), rest.begin(), 0.0);
    }
    return error;
}

} // namespace

std::size_t ClusteredVectors::bytes() const {
    return cluster.size() * sizeof(std::uint32_t) + (weights.size() + bases.size()) * sizeof(float);
}

ClusteredVectors clusteredPca(std::span<const float> values, std::size_t dimensions, std::size_t clusters,
                              std::size_t components) {
    constexpr int rounds = 12; // of Lloyd's iteration; more hardly move the means
    const VectorList vectors{values, dimensions};
    std::vector<float> means = firstMeans(vectors, clusters);
    ClusteredVectors result;
    result.dimensions = dimensions;
    result.components = std::min(components, dimensions);
    result.cluster.resize(vectors.size());
    for (int round = 0; round < rounds; ++round) {
        assign(vectors, {means, dimensions}, result.cluster);
        moveMeans(vectors, result.cluster, means);
    }
    const std::size_t count = means.size() / dimensions;
    std::vector<std::vector<std::size_t>> members(count);
    for (std::size_t i = 0; i < vectors.size(); ++i) members[result.cluster[i]].push_back(i);
    result.weights.resize(result.components * vectors.size());
    result.bases.resize(count * (result.components + 1) * dimensions);
    std::vector<double> errors(count);
    inParallel(static_cast<int>(count), availableThreads(), [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        errors[k] = fitCluster(vectors, members[k], VectorList{means, dimensions}[k], k, result);
    });
    result.rmsError = std::sqrt(std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(values.size()));
    return result;
}

} // namespace shadowbench::techniques
