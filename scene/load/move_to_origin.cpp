#include "scene/load/scene_file.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowbench {
namespace {

/// The eye's distance from the origin, in view distances, from which on a scene is moved. Nearer, a step of single precision
/// at the eye is less than a millionth of the view distance: a thousandth of a pixel at the target.
constexpr double mostDistance = 16;

} // namespace

void moveToOrigin(Scene& scene) {
    const Camera& camera = scene.camera;
    const double view = glm::distance(camera.eye, camera.target);
    if (glm::length(camera.eye) <= mostDistance * view) return;
    const double step = std::exp2(std::floor(std::log2(view))); // a power of two: differences of what is near are exact
    translate(scene, -step * glm::round(camera.eye / step));
}

} // namespace shadowbench
