// A scene far from the world's origin is moved to it when it is loaded, whole.
#include "scene/load/load.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

std::string point(const glm::dvec3& p) { return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", p.x, p.y, p.z); }

/// A box on a ground with everything that has a place in the world, `at` metres from where it stands by default.
Scene sceneAt(const glm::dvec3& at, const std::string& light) {
    const auto placed = [&](double x, double y, double z) { return point(at + glm::dvec3(x, y, z)); };
    const std::string text = fmt::format(
        "title = \"Far\"\nsize = 32\n"
        "camera = {{ eye = {}, target = {}, near = 0.5, far = 40, fovy = 45, path = [{{ frame = 0, shift = [0, 0, 0] }}, "
        "{{ frame = 4, shift = [1, 0, 0] }}] }}\nlight = {{ {} }}\n"
        "lod = {{ frames = 4, band = 0.2, path = [{{ frame = 0, eye = {}, target = {} }}, {{ frame = 3, eye = {}, target = "
        "{} }}] }}\n"
        "[[object]]\nmesh = {{ box = {{ size = [8, 0.3, 8] }} }}\nplace = [{{ at = {}, turn = 30 }}]\n"
        "path = [{{ frame = 0, shift = [0, 0, 0] }}, {{ frame = 4, shift = [0, 1, 0] }}]\n",
        placed(2.25, 6.5, 7.125), placed(0, 0, 0), fmt::vformat(light, fmt::make_format_args(placed(1.5, 6.25, -2.75))),
        placed(3, 3, 3), placed(0, 1, 0), placed(4, 3, 3), placed(0, 2, 0), placed(-0.5, -0.125, 0.25));
    return parseScene(text, "scenes/x.toml", Profile::Gate);
}

const std::string lamp = "kind = \"point\", centre = {0}, path = [{{ frame = 0, centre = {0} }}]";
const std::string sun = "kind = \"directional\", direction = [0.3, -1, 0.2]";

/// That two points are the same once `by` is added to the second's.
void expectMoved(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& by) {
    EXPECT_LT(glm::distance(p, q + by), 1e-9);
}

TEST(MoveToOrigin, MovesAllThatHasAPlaceAlike) {
    for (const glm::dvec3& at : {glm::dvec3(1e6, 0, 0), glm::dvec3(-54321.5, 777.25, 1e5)})
        for (const std::string& light : {lamp, sun}) {
            const Scene far = sceneAt(at, light), near = sceneAt({0, 0, 0}, light);
            EXPECT_EQ(near.moved, glm::dvec3(0));
            const glm::dvec3 by = far.moved + at; // of what stands far against what does not
            EXPECT_LT(glm::length(far.camera.eye), 16);
            expectMoved(far.camera.eye, near.camera.eye, by);
            expectMoved(far.camera.target, near.camera.target, by);
            for (const int frame : {0, 61, 63}) {
                const Snapshot a = snapshot(far, frame), b = snapshot(near, frame);
                expectMoved(a.camera.eye, b.camera.eye, by);
                expectMoved(a.camera.target, b.camera.target, by);
                expectMoved(a.batches[0].placements[0].world[3], b.batches[0].placements[0].world[3], by);
                if (light == lamp) expectMoved(a.light.centre, b.light.centre, by);
                EXPECT_EQ(a.light.direction, b.light.direction);
            }
            for (const double frame : {0.0, 3.0}) {
                expectMoved(far.lod->eye.at(frame, {}), near.lod->eye.at(frame, {}), by);
                expectMoved(far.lod->target.at(frame, {}), near.lod->target.at(frame, {}), by);
            }
        }
}

TEST(MoveToOrigin, DifferencesOfWhatIsNearStayExact) {
    const Scene far = sceneAt({1e6, 0, -1e6}, lamp);
    EXPECT_EQ(far.camera.eye - far.camera.target, glm::dvec3(2.25, 6.5, 7.125));
    EXPECT_EQ(far.light.centre - far.camera.target, glm::dvec3(1.5, 6.25, -2.75));
}

TEST(MoveToOrigin, LeavesScenesThatSinglePrecisionHolds) {
    for (const std::string& id : builtinScenes()) {
        if (id != "large-world") {
            EXPECT_EQ(loadScene(id, Profile::Gate).moved, glm::dvec3(0)) << id;
        }
    }
    EXPECT_EQ(sceneAt({100, 0, 0}, sun).moved, glm::dvec3(0));
    EXPECT_NE(sceneAt({1000, 0, 0}, sun).moved, glm::dvec3(0));
}

} // namespace
} // namespace shadowbench
