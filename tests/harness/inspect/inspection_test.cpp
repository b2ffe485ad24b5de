// Scenes as people write them at first, each with one mistake: what is said of it, and that nothing is said of a sound one.
#include "harness/inspect/inspection.h"

#include "base/files.h"
#include "base/temporary_folder.h"
#include "scene/load/load.h"
#include "tests/support/message_of.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace shadowbench::inspect {
namespace {

/// A slab with a small table on it, of two boxes that share no vertex, as the text of an OBJ file.
class Model {
public:
    Model() {
        add({-4, -0.3, -4}, {4, 0, 4});
        add({-0.6, 1.1, -0.5}, {0.7, 1.4, 0.6});
    }

    void add(const glm::dvec3& low, const glm::dvec3& high) {
        const std::size_t first = corners.size() + 1;
        for (const double z : {low.z, high.z})
            for (const double y : {low.y, high.y})
                for (const double x : {low.x, high.x}) corners.emplace_back(x, y, z);
        for (const std::array<std::size_t, 4> face : {std::array<std::size_t, 4>{1, 3, 4, 2},
                                                      {5, 6, 8, 7},
                                                      {1, 2, 6, 5},
                                                      {3, 7, 8, 4},
                                                      {1, 5, 7, 3},
                                                      {2, 4, 8, 6}}) {
            faces.push_back({first + face[0] - 1, first + face[1] - 1, first + face[2] - 1});
            faces.push_back({first + face[0] - 1, first + face[2] - 1, first + face[3] - 1});
        }
    }

    void turnFaces(std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) std::swap(faces[i][1], faces[i][2]);
    }

    [[nodiscard]] std::string obj() const {
        std::string text;
        for (const glm::dvec3& p : corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
        for (const auto& [a, b, c] : faces) text += fmt::format("f {} {} {}\n", a, b, c);
        return text;
    }

    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::size_t, 3>> faces;
};

struct Setting {
    std::string camera = "eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], near = 0.5, far = 40";
    std::string light = "kind = \"point\", centre = [1.7, 6.1, -2.3]";
    std::string mesh = "file = \"model.obj\"";
    std::string view = "fovy = 45";
    int size = 64;
};

class Inspect : public testing::Test {
protected:
    Scene scene(const Model& model, const Setting& setting = {}) const {
        writeFile(folder_.path() / "model.obj", model.obj());
        writeFile(folder_.path() / "mine.toml",
                  fmt::format("title = \"Mine\"\nsize = {}\ncamera = {{ {}, {} }}\nlight = {{ {} }}\n"
                              "[timeline]\nstill = 1\nmoving = 0\n[[object]]\nname = \"model\"\nmesh = {{ {} }}\n",
                              setting.size, setting.camera, setting.view, setting.light, setting.mesh));
        return loadScene((folder_.path() / "mine.toml").string(), Profile::Gate);
    }

    /// All that is warned of, a line each. What is found before a run is the same.
    std::string said(const Model& model, const Setting& setting = {}) const {
        const Scene mine = scene(model, setting);
        std::string lines, before;
        for (const Warning& warning : inspect(mine).warnings) lines += lineOf(warning) + "\n";
        for (const Warning& warning : warningsOf(mine)) before += lineOf(warning) + "\n";
        EXPECT_EQ(lines, before);
        return lines;
    }

    std::string refusal(const Model& model, const Setting& setting = {}) const {
        return test::messageOf<BadInput>([&] { scene(model, setting); });
    }

    TemporaryFolder folder_;
};

void expectWords(const std::string& said, const std::vector<std::string>& words) {
    for (const std::string& word : words) EXPECT_NE(said.find(word), std::string::npos) << word << "\nin: " << said;
}

TEST_F(Inspect, OfASoundSceneNothingIsSaid) {
    EXPECT_EQ(said({}), "");
    EXPECT_EQ(said({}, {.mesh = "file = \"model.obj\", closed = true"}), "");
    EXPECT_EQ(said({}, {.light = "kind = \"directional\", direction = [-0.3, -1, 0.2]"}), "");
    EXPECT_EQ(said({}, {.light = "kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [1, 0, 0], v = [0, 0, 1]"}), "");
    EXPECT_EQ(said({}, {.light = "kind = \"environment\", sky = { constant = 1 }"}), "");
    EXPECT_EQ(said({}, {.camera = "eye = [1470, 4340, 5110], target = [0.1, 0, 0.2], near = 6000, far = 8000",
                        .view = "fovy = 1",
                        .size = 256}),
              ""); // a long lens makes many pixels of what is far away
}

TEST_F(Inspect, CentimetresReadAsMetres) {
    Model model;
    for (glm::dvec3& p : model.corners) p *= 100;
    expectWords(said(model), {"model is 1144 m across, and the camera looks at what is 9.64 m away; if its file is in "
                              "centimetres, write unit = \"cm\" beside it"});
    EXPECT_EQ(said(model, {.mesh = "file = \"model.obj\", unit = \"cm\""}), "");
}

TEST_F(Inspect, ALevelOfAKilometreSeenFromTheGround) {
    Model model;
    model.add({-600, -0.9, -600}, {600, -0.5, 600});
    model.add({300, -0.9, 300}, {310, 40, 310});
    const std::string lines =
        said(model, {.camera = "eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], near = 0.5, far = 3000"});
    // The tower's height draws the map of the lamp, which looks to the scene's middle, away from the table.
    EXPECT_TRUE(lines.starts_with("warning: part of the shadow in view lies outside the 160°")) << lines;
    EXPECT_EQ(std::ranges::count(lines, '\n'), 1) << lines;
}

TEST_F(Inspect, ZUpReadAsYUp) {
    Model model;
    for (glm::dvec3& p : model.corners) p = {p.x, -p.z, p.y};
    expectWords(said(model), {"the largest flat surface stands upright, across z", "write up = \"z\" beside it"});
    EXPECT_EQ(said(model, {.mesh = "file = \"model.obj\", up = \"z\""}), "");
}

TEST_F(Inspect, TurnedInsideOut) {
    Model model;
    model.turnFaces(0, model.faces.size());
    expectWords(said(model), {"model is closed and turned inside out; write flip = true"});
    EXPECT_EQ(said(model, {.mesh = "file = \"model.obj\", flip = true, closed = true"}), "");
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}), {"wound inside out", "flip = true"});
}

TEST_F(Inspect, HalfTurnedInsideOut) {
    Model model;
    model.turnFaces(0, 6);
    const std::string place = "the first near (";
    expectWords(said(model), {"some faces of model are turned inside out: at ", " edges neighbours face opposite ways",
                              place, "Recalculate Outside"});
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}),
                {"mesh.file: not closed: ", " of its edges belong to two triangles in the same direction", place,
                 "Recalculate Outside", "leave out closed = true"});
}

TEST_F(Inspect, AllOfTheseAtOnce) {
    Model model;
    for (glm::dvec3& p : model.corners) p = {100 * p.x, -100 * p.z, 100 * p.y};
    model.turnFaces(0, 6);
    expectWords(said(model), {"write unit = \"cm\" beside it", "write up = \"z\" beside it", "Recalculate Outside"});
}

TEST_F(Inspect, OnePartOfTwoTurnedInsideOut) {
    Model model;
    model.turnFaces(12, 24); // the table
    expectWords(said(model), {"1 of the 2 parts of model are turned inside out, the first near (-0.6, 1.1, -0.5)",
                              "Recalculate Outside"});
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}),
                {"1 of its 2 parts are turned inside out, the first near (-0.6, 1.1, -0.5)", "or leave out closed = true"});
}

TEST_F(Inspect, ACavityIsNoFault) {
    Model model;
    model.add({-0.3, 1.2, -0.3}, {0.3, 1.3, 0.3}); // within the table
    model.turnFaces(24, 36);
    EXPECT_EQ(said(model, {.mesh = "file = \"model.obj\", closed = true"}), "");
}

TEST_F(Inspect, VerticesFarFromTheirOrigin) {
    Model model;
    for (glm::dvec3& p : model.corners) p += glm::dvec3(1e6, 0, 0);
    expectWords(
        said(model, {.camera = "eye = [1000002.1, 6.2, 7.3], target = [1000000.1, 0, 0.2], near = 0.5, far = 40",
                     .light = "kind = \"point\", centre = [1000001.7, 6.1, -2.3]"}),
        {" are up to 1e+06 m from its own origin", "0.12 m apart", "move them to the origin and give the mesh a place"});
}

TEST_F(Inspect, ANearPlaneThatLeavesNoDepth) {
    expectWords(
        said(Model(), {.camera = "eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], near = 0.000001, far = 40"}),
        {"near is 1e-06 m: surfaces at the target that are 11 m apart have the same depth; make it more than 0.002"});
}

TEST_F(Inspect, AGroundOfTenKilometres) {
    Model model;
    model.add({-5000, -0.9, -5000}, {5000, -0.5, 5000});
    expectWords(said(model, {.light = "kind = \"directional\", direction = [-0.3, -1, 0.4]"}),
                {"a texel of a map of 1024² over the whole scene, which is 1.414e+04 m across, covers ",
                 "make the ground no larger than what is seen"});
}

TEST_F(Inspect, ATriangleOfKilometresNextToTheNearPlane) {
    Model model;
    model.add({-9000, -0.4, -9000}, {9000, -0.3, 9000});
    const std::string far = "eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], far = 40000, near = ";
    const std::string words = "triangles of model are 2.55e+04 m long, and near is 0.05 m: a rasteriser";
    expectWords(said(model, {.camera = far + "0.05"}), {words, " pixels beside its place; cut them, make them no larger"});
    EXPECT_EQ(said(model, {.camera = far + "0.5"}).find("triangles of"), std::string::npos);
}

TEST_F(Inspect, TextWithAByteOrderMarkAndCarriageReturns) {
    scene(Model());
    std::string text = "\xEF\xBB\xBF";
    for (const char c : Model().obj()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    writeFile(folder_.path() / "model.obj", text);
    EXPECT_TRUE(inspect(loadScene((folder_.path() / "mine.toml").string(), Profile::Gate)).warnings.empty());
}

TEST_F(Inspect, AnOpenMesh) {
    Model model;
    model.faces.resize(model.faces.size() - 2);
    EXPECT_EQ(said(model), "") << "open meshes are meshes, too";
    expectWords(textOf(inspect(scene(model)), ""),
                {"not said to be closed, found open", "edges of one triangle: 4, the first near ("});
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}),
                {"not closed: 4 of its edges have no neighbour", "Merge by Distance", "leave out closed = true"});
}

TEST_F(Inspect, ATriangleOfNoArea) {
    Model model;
    model.corners.emplace_back(-4, -0.3, 0);
    model.faces.push_back({1, 17, 5}); // along an edge of the slab
    const std::vector<std::string> words{"the first near (-4, -0.3, 0)", "Degenerate Dissolve"};
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}), words);
    expectWords(refusal(model, {.mesh = "file = \"model.obj\", closed = true"}),
                {"has zero area, as 1 of 25 have", "or leave out closed = true"});
    EXPECT_EQ(said(model), "") << "no image shows it";
    const Inspection found = inspect(scene(model));
    expectWords(textOf(found, ""), words);
    expectWords(textOf(found, ""), {"24 triangles, ", "triangles of no area, which are left out: 1, "});
    EXPECT_EQ(nlohmann::json::parse(jsonOf(found, ""))["meshes"][0]["flat_triangles"]["count"], 1);
}

/// A corner that only such a triangle has is none of the scene: lights are fitted to its bounds.
TEST_F(Inspect, ATriangleOfNoAreaLeavesNoTrace) {
    Model model, sound;
    model.corners.emplace_back(-4, -0.3, 90);
    model.faces.insert(model.faces.begin(), {1, 17, 5});
    const Mesh with = *scene(model).objects[0].levels[0].mesh, without = *scene(sound).objects[0].levels[0].mesh;
    EXPECT_EQ(with.flat.count, 1U);
    EXPECT_EQ(with.positions.size(), 16U);
    EXPECT_EQ(with.triangles.size(), without.triangles.size());
    EXPECT_EQ(with.bounds().high, without.bounds().high);
}

TEST_F(Inspect, NothingButTrianglesOfNoArea) {
    Model model;
    model.corners = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}};
    model.faces = {{1, 2, 3}};
    expectWords(refusal(model), {"has zero area, as 1 of 1 have"});
}

TEST_F(Inspect, VerticesAndTrianglesThatAreThereTwice) {
    Model split; // each triangle with vertices of its own, as many programs write them
    std::vector<glm::dvec3> corners;
    for (auto& face : split.faces)
        for (std::size_t& corner : face) {
            corners.push_back(split.corners[corner - 1]);
            corner = corners.size();
        }
    split.corners = corners;
    EXPECT_EQ(said(split), "");
    expectWords(textOf(inspect(scene(split)), ""), {"found closed"});
    Model twice;
    twice.faces.push_back(twice.faces[7]);
    expectWords(textOf(inspect(scene(twice)), ""), {"triangles with the corners of another: 1, the first near ("});
    expectWords(refusal(twice, {.mesh = "file = \"model.obj\", closed = true"}),
                {"not closed: 3 of its edges belong to more than two triangles", "delete the inner faces"});
}

TEST_F(Inspect, ACoordinateThatIsNoNumber) {
    Model model;
    model.corners[5].y = NAN; // (4, -0.3, 4)
    expectWords(refusal(model), {"mesh.file: ", "position ", " is not finite: (4, nan, 4)"});
}

TEST_F(Inspect, OneTriangle) {
    Model model;
    model.corners.resize(3);
    model.faces = {{1, 2, 3}};
    expectWords(said(model), {"every pixel of a receiver is lit"});
}

TEST_F(Inspect, ALightInABox) {
    expectWords(said({}, {.light = "kind = \"point\", centre = [0, 1.2, 0]"}),
                {"the light is inside model, a closed mesh, and the camera is not; move the light out"});
    expectWords(said({}, {.light = "kind = \"point\", centre = [0, 1.0999999, 0]"}),
                {"the light is less than ", " m from a surface of model; move it away"});
}

TEST_F(Inspect, ACameraInABox) {
    const std::string inside = "eye = [0, 1.2, 0], target = [0, 0, 1], near = 0.001, far = 40";
    expectWords(said({}, {.camera = inside}),
                {"the camera is inside model, a closed mesh, and the light is not; move the camera out"});
    expectWords(refusal({}, {.camera = inside, .mesh = "file = \"model.obj\", closed = true"}),
                {"camera.eye: the camera is inside a closed mesh (instance 1) at frame 0; move it out"});
}

TEST_F(Inspect, ARoomWithCameraAndLightInside) {
    Model room;
    room.add({-5, -0.5, -9}, {5, 9, 9});
    room.turnFaces(room.faces.size() - 12, room.faces.size());
    EXPECT_EQ(said(room), "");
}

TEST_F(Inspect, ALampBetweenTwoFloors) {
    // A shelf over the lamp casts the shadow that is seen above it; the table's is below, to the camera's target.
    Model room;
    room.add({-1, 3.2, -1}, {1, 3.3, 1});
    room.add({-4, 5.5, -4}, {4, 5.6, 4});
    const std::string light = "kind = \"disk\", centre = [0, 2.2, 0], u = [0.2, 0, 0], v = [0, 0, 0.2]";
    const std::string side = "eye = [0.3, 2.6, 9.3], near = 0.5, far = 40, ";
    expectWords(
        said(room, {.camera = side + "target = [0, 0.5, 0]", .light = light, .view = "fovy = 65"}),
        {"part of the shadow in view lies outside the 160° that one map of the light sees, which looks to the side of the"});
    EXPECT_EQ(said({}, {.camera = side + "target = [0, 0.5, 0]", .light = light, .view = "fovy = 65"}), "");
}

TEST_F(Inspect, ALightBelow) {
    expectWords(said({}, {.light = "kind = \"point\", centre = [0, -3, 0]"}),
                {"100 % of what is seen faces away from the light, which is 2.7 m below the whole scene; move it above"});
    expectWords(
        said({}, {.light = "kind = \"directional\", direction = [0.3, 1, -0.2]"}),
        {" % of what is seen faces away from the light; direction points the way that the light travels: is it upside "
         "down? Try [-0.282, -0.941, 0.188]"});
}

TEST_F(Inspect, ALightThatIsShutOut) {
    Model lid;
    lid.add({-9, 6.3, -9}, {9, 6.4, 9});
    expectWords(said(lid, {.light = "kind = \"point\", centre = [1.7, 9.1, -2.3]"}),
                {"no pixel of a receiver is lit: there is nothing to score; model, ", " m from the light, is in the way"});
}

TEST_F(Inspect, NoShadowInView) {
    Model ground;
    ground.corners.resize(8);
    ground.faces.resize(12);
    expectWords(said(ground), {"every pixel of a receiver is lit: there is nothing to score; move the light or the camera"});
}

TEST_F(Inspect, NothingInView) {
    const auto of = [&](const std::string& camera) { return said({}, {.camera = camera}); };
    expectWords(of("eye = [0, 3, 9], target = [0, 3, 20], near = 0.5, far = 40"),
                {"nothing of the scene is in view: all of it is behind the camera; turn the camera's target to the scene, "
                 "whose middle is (0, 0.55, 0)"});
    expectWords(of("eye = [0, 3, 90], target = [0, 0, 0], near = 0.5, far = 40"),
                {"all of it is farther than far; make far more than 9"});
    expectWords(of("eye = [0, 3, 9], target = [0, 0, 0], near = 20, far = 40"), {"nearer than near; make near less than "});
    expectWords(of("eye = [0, 3, 9], target = [40, 3, 0], near = 0.5, far = 40"), {"nothing of the scene is in view; turn"});
}

TEST_F(Inspect, ATinyScene) {
    Model model;
    expectWords(said(model, {.mesh = "file = \"model.obj\", unit = \"mm\""}),
                {"model is 0.01144 m across, and the camera looks at what is 9.64 m away; correct the unit"});
    for (glm::dvec3& p : model.corners) p *= 5e-4;
    expectWords(said(model, {.camera = "eye = [0.00105, 0.0031, 0.00365], target = [0, 0, 0], near = 0.0003, far = 1",
                             .light = "kind = \"point\", centre = [0.00085, 0.00305, -0.00115]"}),
                {"the whole scene is 0.0057 m across; scenes are in metres"});
}

/// From straight above, and so far away that the view is nearly parallel, the light falls at 45° along x: of the plate's
/// shadow, 1.1 m wide in z, the camera sees from the plate's own edge at 0.7 to 0.7 + 1.4.
TEST_F(Inspect, SharesAreThoseOfTheClosedForm) {
    const Inspection found =
        inspect(scene({}, {.camera = "eye = [0, 480, 0], target = [0, 0, 0], up = [0, 0, -1], near = 1, "
                                     "far = 900",
                           .light = "kind = \"directional\", direction = [1, -1, 0]",
                           .view = "fovy = 1",
                           .size = 256}));
    const double side = 480 * 2 * std::tan(glm::radians(0.5));
    EXPECT_EQ(found.frame.lightPoints, 1);
    EXPECT_NEAR(found.frame.receivers, 64 / (side * side), 5e-3);
    EXPECT_NEAR(found.frame.shadowed, 1.4 * 1.1 / 64, 1e-3);
    EXPECT_NEAR(found.frame.lit + found.frame.shadowed, 1, 1e-12);
    EXPECT_NEAR(found.frame.receivers + found.frame.facesAway + found.frame.background, 1, 1e-12);
}

TEST_F(Inspect, AnAreaLightHasAPenumbra) {
    const Inspection found =
        inspect(scene({}, {.light = "kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [1, 0, 0], v = [0, 0, 1]"}));
    EXPECT_EQ(found.frame.lightPoints, 5);
    EXPECT_GT(found.frame.penumbra, 0);
}

TEST_F(Inspect, ThePictureIsLitShadowedAndEmpty) {
    const Inspection found = inspect(scene({}));
    EXPECT_EQ(found.picture.width(), 64);
    const auto [darkest, brightest] = std::ranges::minmax(found.picture, {}, &glm::vec3::x);
    EXPECT_LT(darkest.x, 0.3F);
    EXPECT_GT(brightest.x, 0.7F);
}

TEST_F(Inspect, ThereIsJsonOfAllOfIt) {
    Model model;
    model.turnFaces(0, 6);
    const auto json = nlohmann::json::parse(jsonOf(inspect(scene(model)), "mine.png"));
    EXPECT_EQ(json["scene"], "mine");
    EXPECT_EQ(json["picture"], "mine.png");
    EXPECT_EQ(json["meshes"][0]["found_closed"], false);
    EXPECT_GT(json["meshes"][0]["turned_edges"]["count"], 0);
    EXPECT_EQ(json["warnings"].size(), 1U);
    EXPECT_GT(json["texels"]["median"], 0);
}

TEST(InspectBuiltin, SaysByHowMuchASceneIsMoved) {
    const Inspection far = inspect(loadScene("large-world", Profile::Gate));
    EXPECT_NE(textOf(far, "").find("moved     by (-100000, -216, 71992), to the origin"), std::string::npos)
        << textOf(far, "");
    EXPECT_EQ(textOf(inspect(loadScene("contact", Profile::Gate)), "").find("moved"), std::string::npos);
}

TEST(InspectBuiltin, NothingIsSaidButOfSizesAndMapsThatAFewScenesAreThereToShow) {
    const std::map<std::string, std::string> expected{
        {"large-world", "a texel of a map of 1024² over the whole scene"},
        {"colonnade", "part of the shadow in view lies outside the 160°"},
        {"interior", "part of the shadow in view lies outside the 160°"},
        {"tessellation", "part of the shadow in view lies outside the 160°"},
    };
    for (const std::string& id : builtinScenes()) {
        std::string lines;
        for (const Warning& warning : warningsOf(loadScene(id, Profile::Gate))) lines += lineOf(warning) + "\n";
        const auto found = expected.find(id);
        if (found == expected.end())
            EXPECT_EQ(lines, "") << id;
        else
            EXPECT_NE(lines.find(found->second), std::string::npos) << id << ": " << lines;
    }
}

} // namespace
} // namespace shadowbench::inspect
