// What the camera of a snapshot sees, by exact hits and labels.
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"
#include "harness/inspect/inspection.h"

#include <memory>

namespace shadowbench::groundtruth::geometry {
class SceneTriangles; // groundtruth/cgal/geometry/triangles.h
}

namespace shadowbench::inspect {

/// A snapshot whose triangles are prepared once for several images, of other lights and cameras, too.
class View {
public:
    explicit View(const Snapshot& snapshot);

    struct Seen {
        groundtruth::PrimaryHits hits;
        Image<float> visibility; // mean label over the light's points; 0 where there is no receiver
        FrameReport report;
    };
    /// With `allPoints` an area light is five points, else its centre.
    [[nodiscard]] Seen seen(const Light& light, glm::ivec2 size, bool allPoints) const;

    /// The surface nearest to the light on the way to `point`, and how far from the light it lies; 0: there is none. Of a
    /// directional light the way begins outside of the scene.
    struct Hiding {
        std::uint32_t id = 0;
        double distance = 0;
    };
    [[nodiscard]] Hiding hides(const glm::dvec3& point) const;

    [[nodiscard]] Image<glm::vec3> picture(const Seen& seen) const;
    /// Nothing of an environment, which has no map.
    [[nodiscard]] std::optional<metrics::Aliasing> texels(const Seen& seen) const;

private:
    [[nodiscard]] Image<glm::vec3> normals(const groundtruth::PrimaryHits& hits) const; // towards the eye

    const Snapshot& snapshot_;
    std::shared_ptr<const groundtruth::geometry::SceneTriangles> triangles_;
};

} // namespace shadowbench::inspect
