// A renderer written by the description alone: rays through the pixels' centres by the matrices of scene.json against the
// triangles of scene.obj. It must see what the truth sees.
#include "groundtruth/cgal/hard/exact.h"
#include "tests/scene/exchange/exported_folder.h"
#include "tests/support/test_names.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

struct Triangle {
    std::uint32_t id;
    glm::dvec3 a, b, c;
};

std::vector<Triangle> trianglesOf(const Json& frame, const std::map<std::string, Mesh>& groups) {
    std::vector<Triangle> triangles;
    for (const Json& node : frame["nodes"]) {
        const Mesh& mesh = groups.at(node["mesh"]);
        const glm::dmat4 world = matrixOf(node["matrix"]);
        const auto corner = [&](std::uint32_t i) { return glm::dvec3(world * glm::dvec4(mesh.positions[i], 1)); };
        for (const glm::uvec3& t : mesh.triangles) triangles.push_back({node["id"], corner(t.x), corner(t.y), corner(t.z)});
    }
    return triangles;
}

/// Distance along the ray in lengths of `towards`; infinity for none (Möller and Trumbore 1997).
double hit(const Triangle& t, const glm::dvec3& eye, const glm::dvec3& towards) {
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(towards, ac), from = eye - t.a;
    const double determinant = glm::dot(ab, p);
    const glm::dvec3 q = glm::cross(from, ab);
    const double u = glm::dot(from, p) / determinant, v = glm::dot(towards, q) / determinant;
    const double distance = glm::dot(ac, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : std::numeric_limits<double>::infinity();
}

class SeenFrom : public testing::TestWithParam<std::string> {};

TEST_P(SeenFrom, ItsMatricesEveryPixelShowsWhatTheTruthSees) {
    Scene scene = loadScene(GetParam(), Profile::Gate);
    scene.size = {48, 30}; // not square: an exchange of width and height shows
    const ExportedFolder folder(scene);
    const Json json = folder.json("scene.json");
    const std::map<std::string, Mesh> groups = groupsOf(folder.text("scene.obj"));
    const Json& frame = json["frames"].back();
    const groundtruth::PrimaryHits truth = groundtruth::hard::primaryHits(snapshot(scene, frame["index"]), scene.size);
    const std::vector<Triangle> triangles = trianglesOf(frame, groups);
    const glm::dmat4 world = glm::inverse(matrixOf(frame["projection"]) * matrixOf(frame["view"]));
    const glm::dvec3 eye = vectorOf(frame["camera"]["eye"]);
    int seen = 0;
    for (int y = 0; y < scene.size.y; ++y)
        for (int x = 0; x < scene.size.x; ++x) {
            const glm::dvec4 far =
                world * glm::dvec4(2 * (x + 0.5) / scene.size.x - 1, 1 - 2 * (y + 0.5) / scene.size.y, 1, 1);
            const glm::dvec3 towards = glm::dvec3(far) / far.w - eye;
            double nearest = std::numeric_limits<double>::infinity();
            std::uint32_t id = 0;
            for (const Triangle& triangle : triangles)
                if (const double distance = hit(triangle, eye, towards); distance < nearest) {
                    nearest = distance;
                    id = triangle.id;
                }
            ASSERT_EQ(id, truth.id(x, y)) << x << ", " << y;
            if (id == 0) continue;
            ++seen;
            EXPECT_LT(glm::distance(eye + nearest * towards, glm::dvec3(truth.position(x, y))), 1e-5) << x << ", " << y;
        }
    EXPECT_GT(seen, 100);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SeenFrom,
                         testing::Values("stacked-plates", "moving-camera", "moving-caster", "moving-receiver",
                                         "turned-camera"),
                         nameOfText);

} // namespace
} // namespace shadowbench
