#include "techniques/shared/light_views/cube_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {

std::vector<LightView> cubeViews(const glm::dvec3& light, const std::vector<glm::dvec3>& points) {
    double far = 0;
    for (const glm::dvec3& p : points)
        far = std::max({far, std::abs(p.x - light.x), std::abs(p.y - light.y), std::abs(p.z - light.z)});
    far *= 1 + 1e-6;
    const double near = 0.01 * far;
    const glm::dmat4 projection = glm::perspective(glm::half_pi<double>(), 1.0, near, far);

    std::vector<LightView> views;
    for (int side = 0; side < 6; ++side) {
        glm::dvec3 axis(0);
        axis[side / 2] = side % 2 == 0 ? 1 : -1;
        const glm::dvec3 up = side / 2 == 1 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        LightView view;
        view.clipFromWorld = projection * glm::lookAt(light, light + axis, up);
        view.depthFromWorld = glm::dvec4(axis, -glm::dot(axis, light));
        view.near = near;
        view.far = far;
        view.perspective = true;
        view.span = glm::dvec2(2);
        views.push_back(std::move(view));
    }
    return views;
}

std::size_t cubeSide(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * static_cast<std::size_t>(axis) + (direction[axis] < 0 ? 1 : 0);
}

} // namespace shadowbench::techniques
