#include "scene/camera.h"

#include "base/words.h"
#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>

namespace shadowbench {
namespace {

constexpr Words<LightKind, 6> lightKinds{"kind of light",
                                         {{{LightKind::Point, "point"},
                                           {LightKind::Directional, "directional"},
                                           {LightKind::Rectangle, "rectangle"},
                                           {LightKind::Disk, "disk"},
                                           {LightKind::Line, "line"},
                                           {LightKind::Environment, "environment"}}}};

} // namespace

Camera::Basis Camera::basis() const {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return {right, glm::cross(right, forward), forward};
}

glm::dmat4 Camera::view() const { return glm::lookAt(eye, target, up); }

glm::dmat4 Camera::projection(double aspect) const { return glm::perspective(glm::radians(fovy), aspect, near, far); }

glm::dvec3 Camera::ray(glm::dvec2 pixel, glm::ivec2 size) const { return CameraRays(*this, size).at(pixel); }

CameraRays::CameraRays(const Camera& camera, glm::ivec2 size)
    : basis_(camera.basis()), eye_(camera.eye), size_(size), tangent_(std::tan(0.5 * glm::radians(camera.fovy))),
      aspect_(static_cast<double>(size.x) / size.y) {}

glm::dvec3 CameraRays::at(glm::dvec2 pixel) const {
    const double x = (2.0 * pixel.x / size_.x - 1.0) * tangent_ * aspect_;
    const double y = (1.0 - 2.0 * pixel.y / size_.y) * tangent_;
    return basis_.forward + x * basis_.right + y * basis_.up;
}

glm::dvec3 Camera::project(const glm::dvec3& world, glm::ivec2 size) const {
    const Basis b = basis();
    const glm::dvec3 offset = world - eye;
    const double depth = glm::dot(offset, b.forward);
    const double tangent = std::tan(0.5 * glm::radians(fovy));
    const double aspect = static_cast<double>(size.x) / size.y;
    const double x = glm::dot(offset, b.right) / (depth * tangent * aspect);
    const double y = glm::dot(offset, b.up) / (depth * tangent);
    return {0.5 * (x + 1.0) * size.x, 0.5 * (1.0 - y) * size.y, depth};
}

std::string_view name(LightKind kind) { return lightKinds.of(kind); }

bool Light::isArea() const { return kind == LightKind::Rectangle || kind == LightKind::Disk || kind == LightKind::Line; }

glm::dvec4 Light::homogeneous() const {
    return kind == LightKind::Directional || isEnvironment() ? glm::dvec4(-direction, 0.0) : glm::dvec4(centre, 1.0);
}

glm::dvec3 Light::sample(glm::dvec2 st) const {
    switch (kind) {
    case LightKind::Rectangle:
        return centre + (st.x - 0.5) * u + (st.y - 0.5) * v;
    case LightKind::Line:
        return centre + (st.x - 0.5) * u;
    case LightKind::Disk: {
        const double radius = 0.5 * std::sqrt(st.x); // u and v are diameters
        const double angle = glm::two_pi<double>() * st.y;
        return centre + radius * std::cos(angle) * u + radius * std::sin(angle) * v;
    }
    case LightKind::Point:
    case LightKind::Directional:
    case LightKind::Environment:
        break;
    }
    return centre;
}

Light Light::centreOnly() const {
    if (isEnvironment()) return {LightKind::Directional, centre, direction, glm::dvec3(0), glm::dvec3(0)};
    if (!isArea()) return *this;
    return {LightKind::Point, centre, direction, glm::dvec3(0), glm::dvec3(0)};
}

bool operator==(const Light& a, const Light& b) {
    const auto place = [](const Light& light) {
        return std::tie(light.kind, light.centre, light.direction, light.u, light.v);
    };
    if (place(a) != place(b) || (a.environment == nullptr) != (b.environment == nullptr)) return false;
    return a.environment == b.environment || *a.environment == *b.environment;
}

} // namespace shadowbench
