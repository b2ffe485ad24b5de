// Pixel areas by rays.
#include "base/random.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/pixel_area.h"
#include "groundtruth/cgal/hard/rays.h"

#include <cmath>

namespace shadowbench::groundtruth::hard {
AreaShares sharesByRays(const SceneTriangles& scene, const Camera& camera, const Light& light, glm::ivec2 size,
                        glm::ivec2 pixel, std::uint32_t surface, int side, std::uint16_t set) {
    const CameraRays rays(camera, size);
    std::size_t cast = 0, seen = 0, lit = 0;
    const auto castThrough = [&](glm::dvec2 inside) {
        ++cast;
        const Ray ray{camera.eye, rays.at(glm::dvec2(pixel) + inside)};
        const std::optional<SeenPoint> hit = seenAlong(scene, camera, light, ray);
        if (!hit || hit->surface != Surface::Receiver) return;
        if (scene.instances()[hit->name.instance].id != surface) return;
        ++seen;
        const ReceiverPoint point(ray, scene.triangle(hit->name));
        if (shadowLabel(scene, point, hit->name, light.homogeneous()) != Blocking::Blocks) ++lit;
    };
    const std::uint64_t row = static_cast<std::uint64_t>(set) << 16U | static_cast<std::uint16_t>(pixel.y);
    Random random(row << 32U | static_cast<std::uint32_t>(pixel.x));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double right = random.uniform(), down = random.uniform();
            castThrough(glm::dvec2(x + right, y + down) / static_cast<double>(side));
        }
    if (lit == 0 || lit == seen) castThrough(glm::dvec2(0.5)); // the mean must not contradict the centre's label
    const auto all = static_cast<double>(cast);
    AreaShares shares{static_cast<double>(seen) / all, static_cast<double>(lit) / all, 0};
    if (seen == 0) return shares;
    const double mean = shares.lit / shares.seen;
    shares.sigma = std::sqrt(mean * (1 - mean) / static_cast<double>(seen));
    return shares;
}

} // namespace shadowbench::groundtruth::hard
