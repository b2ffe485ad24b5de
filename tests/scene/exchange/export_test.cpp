// What a user's own scene may hold, and where it is written.
#include "base/error.h"
#include "base/image_io.h"
#include "tests/scene/exchange/exported_folder.h"
#include "tests/scene/exchange/same_scene.h"
#include "tests/support/message_of.h"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <set>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using exchange::exportScene;
using test::messageOf;

const std::string kHead = "# Shows \"it\".\ntitle = \"x\"\nsize = [64, 40]\n"
                          "camera = { eye = [0.1, 2.3, 6.7], target = [0, 0.1, 0], fovy = 41.3, near = 0.1, far = 60 }\n";
const std::string kPoint = "light = { kind = \"point\", centre = [1.1, 5.3, 2.7] }\n";
const std::string kBox = "[[object]]\nmesh = { box = { size = [2.1, 1.3, 2.7] } }\n";

Scene sceneOf(const std::string& toml, const std::string& file = "scenes/own.toml") {
    return parseScene(toml, file, Profile::Gate);
}

Scene exportedAndLoaded(const Scene& scene) {
    const ExportedFolder folder(scene);
    return loadScene(folder.path().string(), Profile::Gate);
}

TEST(Export, KeepsEveryKindOfMotionAndLevel) {
    const Scene scene = sceneOf(
        "# Shows \"it\".\ntitle = 'A \"quoted\" \\ title, über alles # no comment'\nsize = [64, 40]\n"
        "camera = { eye = [0.1, 2.3, 6.7], target = [0, 0.1, 0], fovy = 41.3, near = 0.1, far = 60, path = [\n"
        "    { frame = -3, shift = [1, 0, 0] }, { frame = 0, shift = [0, 0, 0] }, { frame = 2.5, shift = [0.1, 0, 0] } ] }\n"
        "light = { kind = \"directional\", direction = [0.3, -1.7, 0.9], path = [\n"
        "    { frame = 0, direction = [0.3, -1.7, 0.9] }, { frame = 3, direction = [0.4, -1.7, 0.8] } ] }\n"
        "[timeline]\nstill = 4\nmoving = 3\napproach = 3\n"
        "[[object]]\nname = \"two words\"\nmesh = { sphere = { radius = 0.5 } }\nlod = { triangles = [500, 80], until = [8] "
        "}\n"
        "place = [{ at = [1.5, 0.45, 1.5], turn = 33, scale = 1.7 }, { at = [-1.5, 0.45, -1.5] }]\n"
        "spin = { axis = [0.3, 1, 0.2], degrees_per_frame = 7.7, phase = \"random\" }\n"
        "path = [{ frame = 1, shift = [0, 0.1, 0] }, { frame = 3, shift = [0.2, 0.3, 0] }]\n"
        "[[object]]\nname = \"two words\"\ncolour = [0.1, 0.2, 0.3]\nlevels = [{ mesh = { plane = { half = 3 } }, until = "
        "6, "
        "colour = [1, 0, 0.7] }, { mesh = { plane = { half = 3 } } }]\n"
        "[lod]\nframes = 5\nband = 0.5\npath = [{ frame = 0, shift = [0, 0, 0] }, { frame = 4, shift = [0, 0, -1] }]\n"
        "[tolerance]\nmismatch = 0.004\n[expect]\n"
        "fails = [{ technique = \"pcf\", metric = \"mismatch\", above = 0.1, reason = \"it's \\\"soft\\\"\" }]\n"
        "breaks = [{ technique = \"pcf\", axis = \"map\", between = [1, 2], reason = \"x\" }]\n"
        "never_breaks = [{ technique = \"esm\", axis = \"map\", reason = \"y\" }]\n");
    expectSameScene(scene, exportedAndLoaded(scene));
}

/// Directions that normalising changes again in the last bit are many.
TEST(Export, KeepsDirectionsToTheLastBit) {
    for (int i = 10; i < 40; ++i) {
        const Scene scene = sceneOf(
            kHead + fmt::format("light = {{ kind = \"directional\", direction = [0.{}, -1.{}, 0.37] }}\n", i, 7 * i) + kBox +
            fmt::format("spin = {{ axis = [0.{}, 1, 0.2], degrees_per_frame = 3 }}\n", i));
        const Scene again = exportedAndLoaded(scene);
        ASSERT_EQ(scene.light.direction, again.light.direction) << i;
        ASSERT_EQ(scene.objects[0].motion.axis, again.objects[0].motion.axis) << i;
    }
}

TEST(Export, KeepsASkyThatIsAnImage) {
    const TemporaryFolder folder;
    Image<float> sky(8, 4, 0.3F);
    sky(2, 1) = 7.7F;
    writeExr(folder.path() / "own sky.exr", {{"Y", &sky}});
    const Scene scene = sceneOf(kHead +
                                    "[light]\nkind = \"environment\"\nsky = { image = \"own sky.exr\", scale = 0.7 }\n"
                                    "suns = [{ direction = [-0.5, 0.7, 0.4], diameter = 5, radiance = 1000 }]\n" +
                                    kBox,
                                folder.path() / "own.toml");
    const ExportedFolder exported(scene);
    EXPECT_EQ(exported.json("scene.json")["light"]["sky"]["image"], "sky.exr");
    expectSameScene(scene, loadScene(exported.path().string(), Profile::Gate));
}

TEST(Export, NamesAreUniqueAndPlain) {
    const Scene scene =
        sceneOf(kHead + kPoint + "[[object]]\nname = \"a b\"\nmesh = { box = { size = [2, 1, 2] } }\n" +
                "[[object]]\nname = \"a/b\"\nmesh = { box = { size = [1, 1, 1] } }\n" +
                "[[object]]\nname = \"\"\nmesh = { box = { size = [1, 1, 3] } }\nplace = [{ at = [4, 0, 0] }, "
                "{ at = [-4, 0, 0] }]\n");
    const ExportedFolder folder(scene);
    const nlohmann::json json = folder.json("scene.json");
    std::set<std::string> names;
    for (const auto& node : json["frames"][0]["nodes"]) names.insert(node["name"]);
    EXPECT_EQ(names, (std::set<std::string>{"a_b-1", "a_b-2", "object-3", "object-4"}));
    std::set<std::string> meshes;
    for (const auto& mesh : json["meshes"]) meshes.insert(mesh["name"]);
    EXPECT_EQ(meshes, (std::set<std::string>{"a_b", "a_b_2", "object"}));
    expectSameScene(scene, loadScene(folder.path().string(), Profile::Gate));
}

TEST(Export, SameSceneSameBytes) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    const ExportedFolder one(scene), other(scene);
    EXPECT_EQ(one.written.files, other.written.files);
    for (const std::string& file : one.written.files) EXPECT_EQ(one.text(file), other.text(file)) << file;
}

TEST(Export, ReplacesAnEarlierExportWholeAndLeavesOtherFilesAlone) {
    const TemporaryFolder folder;
    exportScene(sceneOf(kHead + kPoint + kBox, "first.toml"), folder.path());
    writeFile(folder.path() / "frame-59.exr", "rendered");
    const exchange::Exported second = exportScene(sceneOf(kHead + kPoint + kBox, "second.toml"), folder.path());
    EXPECT_FALSE(fs::exists(folder.path() / "first.toml"));
    EXPECT_EQ(readFile(folder.path() / "frame-59.exr"), "rendered");
    EXPECT_EQ(loadScene(folder.path().string(), Profile::Gate).id, "second");
    EXPECT_EQ(second.files.back(), "scene.json");
    EXPECT_EQ(second.frames.front(), 59);
}

/// A killed one leaves its list and some files, or one that was being written.
TEST(Export, GoesOnWhereOneWasKilled) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    const Scene scene = sceneOf(kHead + kPoint + kBox);
    exportScene(scene, out);
    EXPECT_FALSE(fs::exists(out / ".scene.json.unfinished"));
    fs::remove(out / "scene.json");
    writeFile(out / ".scene.json.unfinished",
              R"({"format":"shadowbench-scene","files":["scene.bin","scene.gltf","old.toml"]})");
    writeFile(out / "old.toml", "of an export before it");
    writeFile(out / "photo.png", "mine");
    exportScene(scene, out);
    EXPECT_TRUE(fs::exists(out / "scene.json"));
    EXPECT_EQ(readFile(out / "photo.png"), "mine");
    for (const char* gone : {"old.toml", ".scene.json.unfinished"}) EXPECT_FALSE(fs::exists(out / gone)) << gone;

    const fs::path begun = folder.path() / "begun"; // killed at its first file
    fs::create_directory(begun);
    const fs::path half = begun / ".scene.shadowbench-k5sLbg.bin";
    std::ofstream(half) << "half";
    EXPECT_NO_THROW(exportScene(scene, begun));
    EXPECT_FALSE(fs::exists(half));
}

TEST(Export, TakesNoFileOfAnotherFolderForAnEarlierExports) {
    EXPECT_EQ(exchange::exportedFiles(
                  R"({"format": "shadowbench-scene", "files": ["a.toml", "../a", "/a", "b/", ".", "..", "", 1, ["c"]]})"),
              std::vector<std::string>{"a.toml"});
    for (const char* text : {"", "[]", "{", "{\"format\": 1}", R"({"format": "shadowbench-scene", "files": 1})",
                             R"({"format": "shadowbench-scene", "files": {"a": {}}})", R"({"files": ["a"]})"})
        EXPECT_EQ(exchange::exportedFiles(text), std::vector<std::string>()) << text;
    EXPECT_THROW(exchange::exportedFiles(std::string(1000, '[')), BadInput);
}

TEST(Export, RefusesAFolderOfOtherFilesAndAFile) {
    const TemporaryFolder folder;
    const Scene scene = sceneOf(kHead + kPoint + kBox);
    writeFile(folder.path() / "photo.png", "mine");
    EXPECT_NE(messageOf([&] { exportScene(scene, folder.path()); }).find("holds other files; name a new"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { exportScene(scene, folder.path() / "photo.png"); }).find("it is a file"), std::string::npos);
    EXPECT_NE(messageOf([&] { exportScene(scene, ""); }).find("without a name"), std::string::npos);
    EXPECT_EQ(readFile(folder.path() / "photo.png"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

/// The scene file, which is the last but one, cannot be written: what was written before goes away again.
TEST(Export, WritesAllFilesOrNone) {
    const TemporaryFolder folder;
    const Scene scene = sceneOf(kHead + kPoint + kBox, "a/" + std::string(251, 'n') + ".toml"); // longer than names may be
    const fs::path out = folder.path() / "out";
    EXPECT_NE(messageOf([&] { exportScene(scene, out); }).find("cannot write"), std::string::npos);
    EXPECT_FALSE(fs::exists(out));
}

TEST(Export, AFolderIsASceneOnlyWithOneSceneFile) {
    const TemporaryFolder folder;
    const auto load = [&] { loadScene(folder.path().string(), Profile::Gate); };
    EXPECT_NE(messageOf(load).find("a folder without an exported scene"), std::string::npos);
    writeFile(folder.path() / "scene.json", "{}");
    EXPECT_NE(messageOf(load).find("has no .toml files"), std::string::npos);
    writeFile(folder.path() / "a.toml", kHead + kPoint + kBox);
    EXPECT_EQ(messageOf(load), "");
    writeFile(folder.path() / "b.toml", kHead + kPoint + kBox);
    EXPECT_NE(messageOf(load).find("has several .toml files"), std::string::npos);
}

TEST(Export, BelongsToTheProfileThatItWasMadeIn) {
    const ExportedFolder folder(loadScene("simple", Profile::Gate));
    EXPECT_NE(messageOf([&] { loadScene(folder.path().string(), Profile::Paper); }).find("does not belong to profile paper"),
              std::string::npos);
}

struct Damage {
    std::string name, find, replace, message;
};
void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class DamagedGltf : public testing::TestWithParam<Damage> {};

TEST_P(DamagedGltf, IsRefusedByNameAndReason) {
    const ExportedFolder folder(sceneOf(kHead + kPoint + kBox));
    const fs::path file = folder.path() / "scene.gltf";
    std::string text = readFile(file);
    const std::size_t at = text.find(GetParam().find);
    ASSERT_NE(at, std::string::npos);
    writeFile(file, text.replace(at, GetParam().find.size(), GetParam().replace));
    const std::string message = messageOf([&] { loadScene(folder.path().string(), Profile::Gate); });
    EXPECT_NE(message.find("own.toml:"), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, DamagedGltf,
    testing::Values(Damage{"NoJson", "{", "[", "not valid JSON"},
                    Damage{"OtherVersion", "\"2.0\"", "\"1.0\"", "no glTF 2.0"},
                    Damage{"OtherName", "\"meshes\": [\n  {\"name\":\"object_1\"", "\"meshes\": [\n  {\"name\":\"objekt_1\"",
                           "has no mesh \"object_1\" (did you mean \"objekt_1\"?)"},
                    Damage{"NoBuffer", "scene.bin", "other.bin", "other.bin"},
                    Damage{"InsideTheFile", "scene.bin", "data:,x", "the data URI of buffers[0] is no base64"},
                    Damage{"TooLong", "\"count\":8", "\"count\":9999", "reaches beyond its buffer"},
                    Damage{"WrongKind", "\"count\":8", "\"count\":\"8\"", "is no whole number"},
                    Damage{"NoSuchNumber", "\"indices\"", "\"mode\":4e32,\"indices\"", "4e+32 is no whole number"},
                    Damage{"NoIndices", "\"indices\"", "\"other\"", "its 8 corners are no list of triangles"},
                    Damage{"NoFloats", "5126", "5125", "positions are no 32-bit floats"},
                    Damage{"NoView", "\"bufferView\":1", "\"bufferView\":7", "has no bufferViews[7]"}),
    [](const auto& test) { return test.param.name; });

} // namespace
} // namespace shadowbench
