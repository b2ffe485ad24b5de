#include "scene/spherical_harmonics.h"

#include <cmath>
#include <numbers>

namespace shadowbench {

int harmonicBands(std::size_t coefficients) {
    const auto bands = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(coefficients))));
    return bands * bands == coefficients ? static_cast<int>(bands) : 0;
}

std::vector<double> harmonics(const glm::dvec3& direction, int bands) {
    std::vector<double> values(static_cast<std::size_t>(bands) * static_cast<std::size_t>(bands));
    const auto at = [&](int l, int m) -> double& {
        const int index = l * (l + 1) + m;
        return values[static_cast<std::size_t>(index)];
    };
    // sine and cosine are sinᵐθ sin mφ and sinᵐθ cos mφ, polynomials in x and y.
    double sine = 0, cosine = 1;
    double top = std::sqrt(0.25 * std::numbers::inv_pi); // normalised P_m^m without sinᵐθ
    for (int m = 0; m < bands; ++m) {
        if (m > 0) {
            const double next = cosine * direction.x - sine * direction.y;
            sine = sine * direction.x + cosine * direction.y;
            cosine = next;
            top *= std::sqrt((2.0 * m + 1) / (2.0 * m));
        }
        double before = 0, legendre = top;
        for (int l = m; l < bands; ++l) {
            const double scale = m == 0 ? 1 : std::numbers::sqrt2;
            at(l, m) = scale * cosine * legendre;
            if (m > 0) at(l, -m) = scale * sine * legendre;
            // The normalised recurrence in l: P_{l+1} = a (z P_l − P_{l−1} / a_before).
            const auto factor = [m](double degree) {
                return std::sqrt((4 * degree * degree - 1) / (degree * degree - static_cast<double>(m) * m));
            };
            const double next = factor(l + 1) * (direction.z * legendre - (l > m ? before / factor(l) : 0));
            before = legendre;
            legendre = next;
        }
    }
    return values;
}

double harmonicSum(const std::vector<double>& coefficients, const glm::dvec3& direction) {
    const std::vector<double> basis = harmonics(direction, harmonicBands(coefficients.size()));
    double sum = 0;
    for (std::size_t i = 0; i < basis.size(); ++i) sum += coefficients[i] * basis[i];
    return sum;
}

} // namespace shadowbench
