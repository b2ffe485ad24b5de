// Camera and light: the definitions that the rasteriser, the exact oracles and POV-Ray share.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string_view>

namespace shadowbench {

/// Pinhole camera: looks from `eye` to `target`, vertical field of view in degrees, near and far in metres.
struct Camera {
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 target{0, 0, -1};
    glm::dvec3 up{0, 1, 0};
    double fovy = 45;
    double near = 0.1;
    double far = 100;

    /// Orthonormal right, up and forward.
    struct Basis {
        glm::dvec3 right, up, forward;
    };
    [[nodiscard]] Basis basis() const;
    [[nodiscard]] glm::dmat4 view() const;
    [[nodiscard]] glm::dmat4 projection(double aspect) const; // OpenGL clip space, finite far plane

    /// Direction (not normalised, unit length along `forward`) from the eye through image position `pixel`, given in pixels
    /// with row 0 at the top: the centre of pixel (x, y) is (x + ½, y + ½). This double-precision ray defines the truth's
    /// pixel.
    [[nodiscard]] glm::dvec3 ray(glm::dvec2 pixel, glm::ivec2 size) const;

    /// Image position of a world point in pixels (inverse of `ray`) and its distance along `forward` (≤ 0: behind the eye).
    [[nodiscard]] glm::dvec3 project(const glm::dvec3& world, glm::ivec2 size) const;

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// `Camera::ray` of many pixels: the same directions to the bit.
class CameraRays {
public:
    CameraRays(const Camera& camera, glm::ivec2 size);
    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    [[nodiscard]] glm::dvec3 at(glm::dvec2 pixel) const;

private:
    Camera::Basis basis_;
    glm::dvec3 eye_;
    glm::ivec2 size_;
    double tangent_, aspect_;
};

struct EnvironmentLight; // scene/sky.h

enum class LightKind { Point, Directional, Rectangle, Disk, Line, Environment };
std::string_view name(LightKind kind);

/// One light. `centre` is the position of a point light and the middle of an area light; a directional light shines along
/// `direction` (unit length, away from the light). `u` and `v` are a rectangle's full side vectors; a disk's diameters at
/// right angles; a line has only `u`. An environment (scene/sky.h) is all around, and `direction` is the mean one of its
/// light.
struct Light {
    LightKind kind = LightKind::Point;
    glm::dvec3 centre{0, 0, 0};
    glm::dvec3 direction{0, -1, 0};
    glm::dvec3 u{0, 0, 0};
    glm::dvec3 v{0, 0, 0};
    std::shared_ptr<const EnvironmentLight> environment{}; // null unless that is the kind

    [[nodiscard]] bool isArea() const;
    [[nodiscard]] bool isEnvironment() const { return kind == LightKind::Environment; }

    /// Homogeneous position: (centre, 1), or (−direction, 0) for a directional light and an environment.
    [[nodiscard]] glm::dvec4 homogeneous() const;

    /// Point of the light for parameters in [0, 1)², uniform in area: rectangle centre + (s−½)u + (t−½)v, disk by the
    /// concentric square-root map, line by s alone. The centre for other lights.
    [[nodiscard]] glm::dvec3 sample(glm::dvec2 st) const;

    /// The point light at the centre of an area light (what a hard technique lights from). Of an environment, the
    /// directional light of its mean direction: no shadow of it is true, but pictures are lit and shadow maps timed with it.
    /// Other kinds unchanged.
    [[nodiscard]] Light centreOnly() const;

    friend bool operator==(const Light& a, const Light& b); // an environment by what it holds
};

} // namespace shadowbench
