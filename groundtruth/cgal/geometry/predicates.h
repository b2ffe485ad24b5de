// Exact decisions about rays, triangles and segments to a light. Inputs are doubles taken at face value; every answer is the
// sign of a polynomial in them, by interval arithmetic first and by exact integers where the interval is not certain.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace shadowbench::groundtruth::geometry {

using Triangle = std::array<glm::dvec3, 3>;

/// Points origin + t · direction, t > 0.
struct Ray {
    glm::dvec3 origin, direction;
};

/// Certain bounds of the parameter at which a ray meets a triangle (its border included); nothing if it misses or lies in
/// its plane.
struct DepthBounds {
    double low, high;
};
std::optional<DepthBounds> crossing(const Ray& ray, const Triangle& triangle);

/// −1, 0 or 1: does the ray meet the plane of `a` before, with or after that of `b`? Neither plane contains the direction.
int compareDepth(const Ray& ray, const Triangle& a, const Triangle& b);

/// The same for a triangle's plane and parameter `t`.
int compareDepth(const Ray& ray, const Triangle& triangle, double t);

/// Side of the triangle's plane on which `point` lies: 1 where a, b, c appear counter-clockwise, 0 in the plane. Homogeneous
/// points with w = 1 or w = 0 (a direction).
int side(const Triangle& triangle, const glm::dvec4& point);

/// 1 for a vertex below the light (on the receiver's side of the parallel plane through it), 0 at its level, −1 above it.
int belowLight(const Triangle& plane, const glm::dvec4& light, const glm::dvec3& vertex);

/// The triangle with the corners in the order in which they appear counter-clockwise from the (homogeneous) light.
Triangle facing(Triangle triangle, const glm::dvec4& light);

/// The exact point where a ray meets a triangle's plane.
class ReceiverPoint {
public:
    ReceiverPoint(const Ray& ray, const Triangle& triangle);
    ~ReceiverPoint();
    ReceiverPoint(const ReceiverPoint&) = delete;
    ReceiverPoint& operator=(const ReceiverPoint&) = delete;

    /// A point that is no farther away than `nearError` per axis.
    [[nodiscard]] const glm::dvec3& near() const { return near_; }
    [[nodiscard]] const glm::dvec3& nearError() const { return nearError_; }

    [[nodiscard]] const glm::dvec3& low() const {
        return bounds().low;
    } // certain bounds, some units in the last place apart
    [[nodiscard]] const glm::dvec3& high() const { return bounds().high; }
    [[nodiscard]] glm::dvec3 rounded() const { return 0.5 * (low() + high()); }

    /// Certain bounds of the exact point minus `rounded()`, relatively some units in the last place apart.
    struct Remainder {
        glm::dvec3 low, high;
    };
    [[nodiscard]] Remainder remainder() const;

    struct Exact;
    [[nodiscard]] const Exact& exact() const; // made when first needed

private:
    struct Bounds {
        glm::dvec3 low, high;
    };
    const Bounds& bounds() const; // made when first needed
    bool roundNear();             // whether rounded arithmetic can bound its error

    Ray ray_;
    Triangle triangle_;
    glm::dvec3 near_{}, nearError_{};
    mutable std::optional<Bounds> bounds_;
    mutable std::unique_ptr<Exact> exact_;
};

/// Side of the triangle's plane on which the exact point lies.
int side(const Triangle& triangle, const ReceiverPoint& point);

/// What a triangle does to the open segment from a receiver point to a (homogeneous) light.
enum class Blocking {
    None,    // misses it, or its plane contains the point or the light
    Touches, // meets it in a point of the triangle's border
    Blocks,  // crosses it inside
};
Blocking blocking(const ReceiverPoint& point, const glm::dvec4& light, const Triangle& triangle);

/// Whether triangles that only touch the segment block it together: seen along the segment, they leave no direction free
/// around it (a segment through the edge between two triangles of one surface). `touching` holds triangles for which
/// `blocking` is Touches.
bool blockTogether(const ReceiverPoint& point, const glm::dvec4& light, std::span<const Triangle> touching);

} // namespace shadowbench::groundtruth::geometry
