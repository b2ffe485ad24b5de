#include "groundtruth/cgal/hard/sky_irradiance.h"

#include "base/error.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/hard/rays.h"

#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::hard {
namespace {

/// Unit length, on the side of the triangle on which the eye lies; which side that is, is decided exactly.
glm::dvec3 normalTowards(const Triangle& triangle, const glm::dvec3& eye) {
    const glm::dvec3 normal = glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    return side(triangle, glm::dvec4(eye, 1)) < 0 ? -normal : normal;
}

TriangleName seenTriangle(const SceneTriangles& triangles, const PrimaryHits& primary, int x, int y) {
    return {triangles.instanceOf(primary.id(x, y)), primary.triangle(x, y)};
}

} // namespace

Image<glm::dvec3> seenNormals(const Snapshot& snapshot, const SceneTriangles& triangles, const PrimaryHits& primary) {
    Image<glm::dvec3> normals(primary.id.width(), primary.id.height(), glm::dvec3(0));
    for (int y = 0; y < primary.id.height(); ++y)
        for (int x = 0; x < primary.id.width(); ++x)
            if (primary.id(x, y) != 0)
                normals(x, y) =
                    normalTowards(triangles.triangle(seenTriangle(triangles, primary, x, y)), snapshot.camera.eye);
    return normals;
}

Irradiance ExactSky::irradiance(glm::ivec2 pixel, const PrimaryHits& primary,
                                std::span<const SkyDirection> directions) const {
    if (primary.id(pixel.x, pixel.y) == 0)
        throw InternalError("The irradiance was asked for at a pixel that sees no surface.");
    const TriangleName receiver = seenTriangle(*triangles_, primary, pixel.x, pixel.y);
    const Triangle triangle = triangles_->triangle(receiver);
    const glm::dvec3 normal = normalTowards(triangle, camera_.eye);
    const glm::ivec2 size(primary.id.width(), primary.id.height());
    const ReceiverPoint point(pixelRay(camera_, pixel.x, pixel.y, size), triangle);

    Irradiance sums;
    for (const SkyDirection& direction : directions) {
        const double weight = direction.irradiance * irradianceWeight(direction.towards, normal);
        if (weight == 0) continue;
        sums.unoccluded += weight;
        if (shadowLabel(*triangles_, point, receiver, glm::dvec4(direction.towards, 0)) != Blocking::Blocks)
            sums.arriving += weight;
    }
    return sums;
}

} // namespace shadowbench::groundtruth::hard
