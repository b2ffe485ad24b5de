// From the light through an occluder's vertex onto the receiver's plane, and from there into the image: one projective map.
#pragma once

#include "groundtruth/cgal/geometry/predicates.h"
#include "scene/camera.h"

#include <glm/vec2.hpp>
#include <memory>
#include <span>

namespace shadowbench::groundtruth::geometry {

/// Homogeneous image position (x, y, w): pixels times w. Linear in the world point, w > 0 where the shadow lies before the
/// camera. The true value lies within `error` per component. `lightSide` is linear too and positive below the light
/// (parallel to the plane).
struct ShadowVertex {
    glm::dvec3 position;
    glm::dvec3 error;
    double lightSide;
};

class ShadowProjection {
public:
    /// `light` (homogeneous) and the camera's eye lie strictly on one side of the plane of `receiver`.
    ShadowProjection(const Triangle& receiver, const glm::dvec4& light, const Camera& camera, glm::ivec2 size);
    ~ShadowProjection();
    ShadowProjection(const ShadowProjection&) = delete;
    ShadowProjection& operator=(const ShadowProjection&) = delete;

    /// The receiver's triangle, turned to face the light.
    [[nodiscard]] const Triangle& receiver() const { return receiver_; }

    /// Exact sign of the height above the receiver's plane, positive on the light's side.
    [[nodiscard]] int height(const glm::dvec3& vertex) const;

    [[nodiscard]] ShadowVertex project(const glm::dvec3& vertex) const;

    /// Where the edge between two vertices of opposite height meets the plane: the same for (a, b) and (b, a) only bit for
    /// bit if the caller keeps one order.
    [[nodiscard]] ShadowVertex contact(const glm::dvec3& a, const glm::dvec3& b) const;

    /// Pixels around the image beyond which no shadow's edge matters.
    static constexpr int margin = 3;
    /// Do the shadows of the points and of all between them surely lie beyond one border of the image and its margin, above
    /// the light's level or behind the camera?
    [[nodiscard]] bool misses(std::span<const glm::dvec3> points) const;

    /// How far, in pixels, a pixel's exact ray may be from its nominal centre because Camera::ray rounds.
    [[nodiscard]] double pixelError() const { return pixelError_; }

private:
    struct Map;
    /// slope · (point − receiver()[0]) + offset is positive on the image's side. It is wrong by at most the errors, that of
    /// the slope by the metre along the axes.
    struct Border {
        glm::dvec3 slope;
        double offset, slopeError, offsetError;
    };
    void findBorders(glm::ivec2 size);

    Triangle receiver_;
    std::unique_ptr<Map> map_;
    std::array<Border, 6> borders_{};
    double pixelError_;
};

} // namespace shadowbench::groundtruth::geometry
