// What parts of an area light bring to a surface point: irradiance, as a diffuse emitter, and solid angle. In double
// precision; what the point is near to (its own plane, the light's plane) in double-double numbers.
//
// With D from the point P to the light's plane at its distance d, a point of the light at distance r contributes
// cos θ_receiver cos θ_light / r² = h d / r⁴ to the irradiance, where h is its height above the receiver's tangent plane,
// and cos θ_light / r² = d / r³ to the solid angle.
//
// Solid angles are those of two triangles by van Oosterom and Strackee (The solid angle of a plane triangle, 1983): the
// determinant is d times twice the triangle's area, so nothing cancels however small it is. Irradiance is Lambert's sum over
// the edges (Photometria, 1760; Baum, Rushmeier and Winget, Improving radiosity solutions, 1989). Its terms are of the order
// of angles and cancel where the part is small or the light grazes the receiver; where the bound of their rounding is too
// large, the part is cut into smaller ones, and those that are small as seen from P go by Gauss and Legendre's quadrature,
// of positive terms and with as many nodes as the distance of the integrand's poles asks for.
#pragma once

#include "groundtruth/cgal/area/area_shape.h"
#include "groundtruth/cgal/area/area_view.h"

namespace shadowbench::groundtruth::area {

/// A trapezoid in light coordinates, its parallel sides along u; left ≤ right.
struct LightPart {
    double low, high;
    double lowLeft, lowRight, highLeft, highRight;
};

/// The light of a surface point that does not lie in its plane, and above whose tangent plane all of its square lies.
class LightWeights {
public:
    LightWeights(const Light& light, const SurfacePoint& point);

    /// Proportional to the irradiance through the part; the factor is the light's radiance over the receiver's normal.
    [[nodiscard]] double irradiance(const LightPart& part) const { return irradiance(part, mostCuts); }
    /// Steradian. Near the light it errs by some 1e-16 over the share of the light's size that the point is away.
    [[nodiscard]] double solidAngle(const LightPart& part) const;
    [[nodiscard]] double of(Share share, const LightPart& part) const {
        return share == Share::Irradiance ? irradiance(part) : solidAngle(part);
    }

    /// At most how much of the whole square's weight a part has, over the part's own share of its area.
    [[nodiscard]] double densest(Share share) const;

private:
    static constexpr int mostCuts = 128;

    /// In the light's plane, from the foot of the point: along u, and at a right angle to it.
    [[nodiscard]] glm::dvec2 placed(double x, double y) const;
    [[nodiscard]] double irradiance(const LightPart& part, int cuts) const;
    [[nodiscard]] double quadrature(const LightPart& part, int across, int upwards) const;
    struct Bounded {
        double value, error;
    };
    [[nodiscard]] Bounded lambert(const LightPart& part) const;
    [[nodiscard]] double leastDistance() const; // from the point to the light's square

    double distance_ = 0;   // d
    glm::dvec2 centre_{0};  // where placed(0, 0) is
    double side_ = 0;       // |u|
    glm::dvec2 slope_{0};   // v in the light's plane
    glm::dvec3 heights_{0}; // h = x·heights.x + y·heights.y + heights.z
    glm::dvec3 normal_{0};  // the receiver's, in the frame of the light
    double whole_ = 0;      // irradiance of the square
    double wholeSolidAngle_ = 0;
};

/// The visible share of the shape, of what its parts weigh: hidden is where the winding number of `edges` is positive.
VisibleFraction weighedFraction(const std::vector<CoverEdge>& edges, const LightShape& shape, const LightWeights& weights,
                                Share share);

} // namespace shadowbench::groundtruth::area
