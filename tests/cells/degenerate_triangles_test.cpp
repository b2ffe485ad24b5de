// Casters that turn edge-on to the light, where triangles have no area in a shadow map: exact truth stays right, and maps of
// moments, which are made of a depth buffer, hold none of what interpolation makes of their depth.
#include "tests/support/cell_stage.h"
#include "tests/support/rows_over_frames.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <optional>

namespace shadowbench {
namespace {

/// The scene with its moving frames.
CellScene& spinning() {
    testContext(); // outlives the scene
    static CellScene scene(loadScene("degenerate-triangles", Profile::Gate));
    return scene;
}

TEST(DegenerateTriangles, InEachFrameABladeIsSeenEdgeOnFromTheLight) {
    const Scene& scene = spinning().scene();
    const std::vector<int> frames = scoredFrames(scene);
    ASSERT_EQ(frames.size(), 9U);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Snapshot now = snapshot(scene, frames[i]);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(now.batches[1].placements[i].world[1]));
        EXPECT_LT(std::abs(glm::dot(normal, now.light.direction)), 2e-6) << i; // 10⁻⁴ degrees
    }
}

/// Whether the line from `from` along `along` meets a convex closed mesh: what of it lies behind the planes of all facets.
bool meets(const Mesh& mesh, const glm::dvec3& from, const glm::dvec3& along) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double height = glm::dot(normal, from - a), change = glm::dot(normal, along);
        if (change == 0 && height > 0) return false;
        if (change > 0) leave = std::min(leave, -height / change);
        if (change < 0) enter = std::max(enter, -height / change);
        if (enter > leave) return false;
    }
    return true;
}

/// Whether a point of the ground sees a light in the direction `along`, of which all casters are convex.
bool isLit(const Snapshot& snapshot, const glm::dvec3& point, const glm::dvec3& along) {
    for (std::size_t i = 1; i < snapshot.batches.size(); ++i) {
        const Mesh& mesh = *snapshot.batches[i].mesh;
        const double radius = 0.5 * glm::distance(mesh.bounds().low, mesh.bounds().high);
        for (const Placement& placement : snapshot.batches[i].placements) {
            const glm::dvec3 centre(placement.world * glm::dvec4(mesh.bounds().centre(), 1));
            if (glm::length(glm::cross(centre - point, along)) > radius) continue;
            const glm::dmat4 local = glm::inverse(placement.world);
            if (meets(mesh, glm::dvec3(local * glm::dvec4(point, 1)), glm::dvec3(local * glm::dvec4(along, 0))))
                return false;
        }
    }
    return true;
}

TEST(DegenerateTriangles, ExactLabelsAreThoseOfConvexBodies) {
    CellScene& cells = spinning();
    const Scene& scene = cells.scene();
    for (const int frame : scoredFrames(scene)) {
        const groundtruth::Reference& truth = cells.truths().at(Truth::Hard, frame);
        const Snapshot now = snapshot(scene, frame);
        std::size_t receivers = 0, shadowed = 0, differing = 0;
        for (int y = 0; y < scene.size.y; ++y)
            for (int x = 0; x < scene.size.x; ++x) {
                if (truth.surface(x, y) != groundtruth::Surface::Receiver || truth.id(x, y) != 1) continue;
                const glm::dvec3 ray = now.camera.ray({x + 0.5, y + 0.5}, scene.size);
                const glm::dvec3 point = now.camera.eye - now.camera.eye.y / ray.y * ray; // the ground's top is y = 0
                const bool lit = isLit(now, point, -now.light.direction);
                ++receivers;
                shadowed += lit ? 0 : 1;
                differing += lit == (truth.visibility(x, y) >= 0.5F) ? 0 : 1;
            }
        EXPECT_GT(receivers, 20000U) << frame;
        EXPECT_GT(shadowed, 2000U) << frame;
        EXPECT_EQ(differing, 0U) << frame;
    }
}

TEST(DegenerateTriangles, MapsOfMomentsAreRightInEachFrame) {
    CellScene& cells = spinning();
    Stage& stage = cells.stage();
    for (const std::string variant :
         {"evsm:kernel=3", "evsm:kernel=3,format=RG32F", "evsm:kernel=3,format=RGBA16F,positive=5.54,variance=1.5625e-06",
          "msm:kernel=3", "msm:kernel=3,format=RGBA32F,bias=3e-06"}) {
        const auto row = rowOf(variant);
        for (const int frame : scoredFrames(cells.scene())) {
            stage.show(frame);
            stage.render(*row, frame, 1);
            const Image<float> image = stage.visibility();
            for (const float v : image) ASSERT_TRUE(v >= 0 && v <= 1) << variant << " " << frame;
            const groundtruth::Reference& truth = cells.truths().at(Truth::Hard, frame);
            const metrics::Mask mask = metrics::receiverMask(truth, stage.drawn(), stage.shown().camera.eye);
            const double off = *metrics::labelErrors({image, truth, mask}).mismatchOffEdge;
            EXPECT_LT(off, 0.0003) << variant << " " << frame; // nine pixels and more are a lit square
        }
    }
}

} // namespace
} // namespace shadowbench
