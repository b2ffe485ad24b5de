#include "techniques/environment/harmonic_light.h"

#include "scene/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <variant>

namespace shadowbench::techniques {
namespace {

constexpr double pi = glm::pi<double>();

/// Legendre polynomials P_0 … P_shBands at x.
std::array<double, shBands + 1> legendre(double x) {
    std::array<double, shBands + 1> p{1, x};
    for (int l = 2; l <= shBands; ++l) {
        const auto i = static_cast<std::size_t>(l);
        p.at(i) = ((2 * l - 1) * x * p.at(i - 1) - (l - 1) * p.at(i - 2)) / l;
    }
    return p;
}

/// Band l of `vector` times factor(l).
template <typename Factor>
ShVector bandsScaled(ShVector vector, const Factor& factor) {
    for (int l = 0; l < shBands; ++l) {
        const double scale = factor(l);
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) vector.at(static_cast<std::size_t>(i)) *= scale;
    }
    return vector;
}

void add(ShVector& sum, const ShVector& vector, double times = 1) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum.at(i) += times * vector.at(i);
}

struct Projection {
    ShVector operator()(const ConstantSky& sky) const {
        ShVector result{};
        result[0] = std::sqrt(4 * pi) * sky.radiance;
        return result;
    }

    ShVector operator()(const HarmonicSky& sky) const {
        ShVector result{};
        std::copy_n(sky.coefficients.begin(), std::min(sky.coefficients.size(), result.size()), result.begin());
        return result;
    }

    ShVector operator()(const ImageSky& sky) const {
        const int width = sky.radiance.width(), height = sky.radiance.height();
        ShVector result{};
        for (int y = 0; y < height; ++y) {
            const double solidAngle = 2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
            for (int x = 0; x < width; ++x)
                add(result, shBasis(sky.direction({x + 0.5, y + 0.5})),
                    solidAngle * static_cast<double>(sky.radiance(x, y)));
        }
        return result;
    }
};

} // namespace

ShVector shBasis(const glm::dvec3& direction) {
    ShVector result{};
    std::ranges::copy(harmonics(direction, shBands), result.begin());
    return result;
}

double clampedCosine(int l) {
    if (l == 1) return 2 * pi / 3;
    if (l % 2 == 1) return 0;
    double binomial = 1; // l! / (2^l (l/2)!²)
    for (int k = 1; k <= l / 2; ++k) binomial *= (2.0 * k - 1) / (2.0 * k);
    const double sign = l / 2 % 2 == 1 ? 1 : -1;
    return 2 * pi * sign / ((l + 2) * (l - 1)) * binomial;
}

ShVector unshadowedTransfer(const glm::dvec3& normal) { return bandsScaled(shBasis(normal), clampedCosine); }

ShVector harmonicLight(const Sun& sun) {
    const auto p = legendre(std::cos(0.5 * glm::radians(sun.diameter)));
    // Funk and Hecke: band l is multiplied by 2π times the integral of P_l over the cosines that the disk spans.
    return bandsScaled(shBasis(sun.direction), [&](int l) {
        if (l == 0) return sun.radiance * sun.solidAngle();
        const auto i = static_cast<std::size_t>(l);
        return sun.radiance * 2 * pi * (p.at(i - 1) - p.at(i + 1)) / (2 * l + 1);
    });
}

ShVector harmonicLight(const EnvironmentLight& light) {
    ShVector sum = std::visit(Projection(), light.sky);
    for (const Sun& sun : light.suns) add(sum, harmonicLight(sun));
    return sum;
}

} // namespace shadowbench::techniques
