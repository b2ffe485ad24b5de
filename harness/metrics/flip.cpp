// FLIP. Names and constants are the paper's; sections are cited where they are used.
#include "harness/metrics/flip.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <vector>

namespace shadowbench::metrics {
namespace {

using Plane = Image<float>;
using Kernel = std::vector<float>; // 2r + 1 weights
using std::numbers::pi;

/// XYZ from linear sRGB, by columns: IEC 61966-2-1 with its primaries and D65 in full precision.
const glm::dmat3 xyzFromRgb{{10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382},
                            {8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382},
                            {4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382}};
const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb);
const glm::dvec3 white = xyzFromRgb * glm::dvec3(1);

/// XYZ relative to white, from linear sRGB and back.
const glm::mat3 relativeFromRgb(glm::dmat3(glm::dvec3(1) / white * xyzFromRgb[0], glm::dvec3(1) / white * xyzFromRgb[1],
                                           glm::dvec3(1) / white * xyzFromRgb[2]));
const glm::mat3 rgbFromRelative(white.x* rgbFromXyz[0], white.y* rgbFromXyz[1], white.z* rgbFromXyz[2]);

float labCurve(float t) {
    constexpr float delta = 6.0F / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0F / 29;
}

/// CIELab with chroma that fades with lightness (Section 4.1.3, Hunt's effect).
glm::vec3 huntLab(const glm::vec3& rgb) {
    const glm::vec3 relative = relativeFromRgb * rgb;
    const float x = labCurve(relative.x), y = labCurve(relative.y), z = labCurve(relative.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01F * lightness * 500 * (x - y), 0.01F * lightness * 200 * (y - z)};
}

/// Distance of large differences of colour (Section 4.1.4).
float hyab(const glm::vec3& a, const glm::vec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// Pixels beyond the border are those on it (Section 6).
Plane alongRows(const Plane& in, const Kernel& kernel) {
    const int width = in.width(), radius = static_cast<int>(kernel.size()) / 2;
    Plane out(width, in.height());
    std::vector<float> row(static_cast<std::size_t>(width) + kernel.size() - 1);
    for (int y = 0; y < in.height(); ++y) {
        for (int i = 0; i < static_cast<int>(row.size()); ++i) row[i] = in(std::clamp(i - radius, 0, width - 1), y);
        float* to = &out(0, y);
        for (std::size_t k = 0; k < kernel.size(); ++k)
            for (int x = 0; x < width; ++x) to[x] += kernel[k] * row[x + k];
    }
    return out;
}

Plane alongColumns(const Plane& in, const Kernel& kernel) {
    const int width = in.width(), height = in.height(), radius = static_cast<int>(kernel.size()) / 2;
    Plane out(width, height);
    for (int y = 0; y < height; ++y) {
        float* to = &out(0, y);
        for (int k = 0; k < static_cast<int>(kernel.size()); ++k) {
            const float* from = &in(0, std::clamp(y + k - radius, 0, height - 1));
            for (int x = 0; x < width; ++x) to[x] += kernel[k] * from[x];
        }
    }
    return out;
}

template <class Weight>
Kernel kernelOf(int radius, const Weight& weight) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(weight(x)));
    return kernel;
}

/// A Gaussian of a contrast sensitivity function, a √(π/b) exp(−π² x²/b) with x in degrees (equation 3).
struct Gaussian {
    double a, b;
};

/// A plane filtered by a sum of Gaussians in two dimensions, all weights together 1.
Plane filtered(const Plane& in, const std::vector<Gaussian>& gaussians, int radius, double pixelsPerDegree) {
    Plane sum(in.width(), in.height());
    std::vector<double> rowSums, shares;
    double total = 0;
    const auto weight = [&](const Gaussian& g, int x) {
        return std::exp(-pi * pi * x * x / (g.b * pixelsPerDegree * pixelsPerDegree));
    };
    for (const Gaussian& g : gaussians) {
        double rowSum = 0;
        for (int x = -radius; x <= radius; ++x) rowSum += weight(g, x);
        rowSums.push_back(rowSum);
        shares.push_back(g.a * std::sqrt(pi / g.b) * rowSum * rowSum);
        total += shares.back();
    }
    for (std::size_t i = 0; i < gaussians.size(); ++i) {
        const Kernel kernel = kernelOf(radius, [&](int x) { return weight(gaussians[i], x) / rowSums[i]; });
        const Plane part = alongColumns(alongRows(in, kernel), kernel);
        const auto share = static_cast<float>(shares[i] / total);
        for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += share * part[p];
    }
    return sum;
}

/// Luminance and two opponent colours, linear: CIELab without its curve (Section 4.1.1).
struct Opponent {
    Plane y, cx, cz;
};

Opponent opponentOf(const Image<glm::vec3>& linear) {
    Opponent o{Plane(linear.width(), linear.height()), Plane(linear.width(), linear.height()),
               Plane(linear.width(), linear.height())};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const glm::vec3 relative = relativeFromRgb * glm::clamp(linear[i], 0.0F, 1.0F);
        o.y[i] = relative.y;
        o.cx[i] = relative.x - relative.y;
        o.cz[i] = relative.y - relative.z;
    }
    return o;
}

/// What is left of the colours at this distance (Section 4.1.2, Table 1), as they are seen.
Image<glm::vec3> seenColours(const Opponent& o, double pixelsPerDegree) {
    const std::vector<Gaussian> achromatic{{1, 0.0047}}, redGreen{{1, 0.0053}}, blueYellow{{34.1, 0.04}, {13.5, 0.025}};
    const double sigma = std::sqrt(blueYellow.front().b / (2 * pi * pi)); // degrees: the widest
    const int radius = static_cast<int>(std::ceil(3 * sigma * pixelsPerDegree));
    const Plane y = filtered(o.y, achromatic, radius, pixelsPerDegree);
    const Plane cx = filtered(o.cx, redGreen, radius, pixelsPerDegree);
    const Plane cz = filtered(o.cz, blueYellow, radius, pixelsPerDegree);
    Image<glm::vec3> colours(y.width(), y.height());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const glm::vec3 rgb = rgbFromRelative * glm::vec3(y[i] + cx[i], y[i], y[i] - cz[i]);
        colours[i] = huntLab(glm::clamp(rgb, 0.0F, 1.0F));
    }
    return colours;
}

Plane lengths(const Plane& x, const Plane& y) {
    Plane result(x.width(), x.height());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    return result;
}

/// Positive weights together 1 and negative ones together −1.
Kernel balanced(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
    for (float& weight : kernel) weight /= weight > 0 ? positive : negative;
    return kernel;
}

/// Edges and points of the luminance, as the first and second derivatives of a Gaussian find them (Section 4.2.1).
void findFeatures(const Plane& luminance, double pixelsPerDegree, FlipPicture& picture) {
    constexpr double width = 0.082; // degrees: of the detector
    const double sigma = 0.5 * width * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += gauss(x);
    const Kernel smooth = kernelOf(radius, [&](int x) { return gauss(x) / sum; });
    const Kernel edge = balanced(kernelOf(radius, [&](int x) { return -x * gauss(x); }));
    const Kernel point = balanced(kernelOf(radius, [&](int x) { return (x * x / (sigma * sigma) - 1) * gauss(x); }));
    const Plane rows = alongRows(luminance, smooth);
    picture.edges = lengths(alongColumns(alongRows(luminance, edge), smooth), alongColumns(rows, edge));
    picture.points = lengths(alongColumns(alongRows(luminance, point), smooth), alongColumns(rows, point));
}

/// The difference of colours in [0, 1] (Section 4.1.5): what is below pc of the largest takes up pt of the range.
class ColourDifference {
public:
    float operator()(const glm::vec3& a, const glm::vec3& b) const {
        const float difference = std::pow(hyab(a, b), qc), bend = pc * largest_;
        if (difference < bend) return pt / bend * difference;
        return pt + (difference - bend) / (largest_ - bend) * (1 - pt);
    }

private:
    static constexpr float qc = 0.7F, pc = 0.4F, pt = 0.95F;
    float largest_ = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), qc); // green against blue
};

} // namespace

FlipPicture flipPicture(const Image<glm::vec3>& linear, double pixelsPerDegree) {
    const Opponent opponent = opponentOf(linear);
    FlipPicture picture;
    picture.colours = seenColours(opponent, pixelsPerDegree);
    findFeatures(opponent.y, pixelsPerDegree, picture);
    return picture;
}

Image<float> flip(const FlipPicture& a, const FlipPicture& b) {
    if (!a.colours.sameSize(b.colours)) throw InternalError("comparing pictures of different sizes; draw both at one size");
    const ColourDifference colourDifference;
    Image<float> result(a.colours.width(), a.colours.height());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float edges = std::abs(a.edges[i] - b.edges[i]), points = std::abs(a.points[i] - b.points[i]);
        const float features = std::sqrt(std::max(edges, points) / std::numbers::sqrt2_v<float>); // Section 4.2.2: qf is ½
        result[i] = std::pow(colourDifference(a.colours[i], b.colours[i]), 1 - features);         // Section 4.3
    }
    return result;
}

double meanFlip(const FlipPicture& a, const FlipPicture& b) {
    double sum = 0;
    for (const float difference : flip(a, b)) sum += difference;
    return sum / static_cast<double>(a.colours.size());
}

} // namespace shadowbench::metrics
