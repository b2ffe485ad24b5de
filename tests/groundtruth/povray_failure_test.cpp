// What happens when POV-Ray is missing, fails, dies, hangs or writes rubbish: one sentence, and nothing is left behind.
#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "groundtruth/povray/povray.h"
#include "scene/load/load.h"
#include "scene/scene.h"
#include "tests/support/povray_stand_in.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <sys/mount.h>
#include <thread>
#include <unistd.h>

namespace shadowbench::groundtruth {
namespace {

class PovRayFailure : public PovRayStandIn {};

TEST_F(PovRayFailure, AMissingProgramNamesThePackage) {
    const std::string said = sentence({.program = "no-such-povray"});
    EXPECT_TRUE(contains(said, "no-such-povray") && contains(said, "apt-get install povray")) << said;
    EXPECT_THROW(povray::version({.program = "no-such-povray"}), Inconclusive);
}

TEST_F(PovRayFailure, AProgramThatIsNotPovRayHasNoVersion) {
    EXPECT_THROW(povray::version(fake("echo hello")), Inconclusive);
}

TEST_F(PovRayFailure, AProgramThatIsKilledBeforeItNamesItsVersionIsNotCalledAnotherProgram) {
    try {
        (void)povray::version(fake("kill -9 $$"));
        FAIL() << "it has said no version";
    } catch (const Inconclusive& error) {
        EXPECT_TRUE(contains(error.what(), "was killed by signal 9; run it again")) << error.what();
        EXPECT_TRUE(error.isTransient());
    }
}

TEST_F(PovRayFailure, AProgramIsAskedForItsVersionOnce) {
    const std::string body = fmt::format("echo asked >> {}; echo 'POV-Ray 9.8.7 test'", file("asked").string());
    const povray::Options options = fake(body);
    const auto timesAsked = [&] { return std::ranges::count(readFile(file("asked")), '\n'); };
    std::vector<std::string> versions(4);
    std::vector<std::thread> threads;
    for (std::string& version : versions) threads.emplace_back([&] { version = povray::version(options); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(versions, std::vector<std::string>(4, "9.8.7"));
    EXPECT_EQ(timesAsked(), 1);

    fake(body); // another program in its place
    fs::last_write_time(file("povray"), fs::last_write_time(file("povray")) + 1s);
    EXPECT_EQ(povray::version(options), "9.8.7");
    EXPECT_EQ(timesAsked(), 2);
}

TEST_F(PovRayFailure, AnErrorIsReportedEveryTime) {
    const povray::Options options = fake("echo hello");
    for (int i = 0; i < 3; ++i) EXPECT_THROW(povray::version(options), Inconclusive);
}

TEST_F(PovRayFailure, AFileThatCannotBeExecutedIsReported) {
    writeFile(file("povray"), "not a program");
    fs::permissions(file("povray"), fs::perms::owner_all);
    EXPECT_TRUE(contains(sentence({.program = file("povray")}), "cannot start"));
}

TEST_F(PovRayFailure, AFailureNamesTheExitCodeAndTheFirstErrorLine) {
    const std::string said =
        sentence(fake("echo 'povray: cannot open the user configuration file x' >&2\n"
                      "echo \"File 'scene.pov' line 3: Parse Error: No matching } in\" >&2\n"
                      "echo \" 'camera'\" >&2\necho 'Fatal error in parser: Cannot parse input.' >&2\nexit 1"));
    EXPECT_TRUE(contains(said, "exit code 1: File 'scene.pov' line 3: Parse Error: No matching } in 'camera';")) << said;
    EXPECT_FALSE(contains(said, "\n"));
}

TEST_F(PovRayFailure, EndlessOutputIsBounded) {
    const std::string said = sentence(fake("yes 'Error: again and again' | head -c 3000000 | tr -d '\\n' >&2; exit 1"));
    EXPECT_TRUE(contains(said, "exit code 1")) << said.substr(0, 500);
    EXPECT_LT(said.size(), 500U);
}

TEST_F(PovRayFailure, AKilledRenderNamesTheSignal) {
    const std::string said = sentence(fake("kill -9 $$"));
    EXPECT_TRUE(contains(said, "signal 9")) << said;
}

TEST_F(PovRayFailure, AHangEndsAtTheLimitAndTakesItsChildrenAlong) {
    const auto start = std::chrono::steady_clock::now();
    const std::string said = sentence(fake(fmt::format("sleep 100 & echo $! > {}; wait", file("pid").string()), 500ms));
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s); // far below the 100 s that it wanted, far above a slow machine
    EXPECT_TRUE(contains(said, "limit of 0.5 s")) << said;
    EXPECT_TRUE(endsSoon(pidIn("pid")));
}

TEST_F(PovRayFailure, AChildThatOutlivesAFailedRenderIsEnded) {
    sentence(fake(fmt::format("sleep 100 & echo $! > {}; exit 1", file("pid").string())));
    EXPECT_TRUE(endsSoon(pidIn("pid")));
}

TEST_F(PovRayFailure, ATruncatedImageIsNotAResult) {
    writePng(file("whole.png"), Image<glm::vec3>(size.x, size.y, glm::vec3(1)));
    const std::string said = sentence(fake(fmt::format("head -c 100 {} > image.png", file("whole.png").string())));
    EXPECT_TRUE(contains(said, "without a complete image")) << said;
}

TEST_F(PovRayFailure, AnImageOfAnotherSizeIsNotAResult) {
    writePng(file("small.png"), Image<glm::vec3>(size.x, size.y - 1, glm::vec3(1)));
    EXPECT_TRUE(
        contains(sentence(fake(fmt::format("cp {} image.png", file("small.png").string()))), "without a complete image"));
}

TEST_F(PovRayFailure, SuccessWithoutAnImageIsNotAResult) {
    EXPECT_TRUE(contains(sentence(fake("exit 0")), "without a complete image"));
}

TEST_F(PovRayFailure, ValuesThatCountNoSamplesAreNotAResult) {
    writePng(file("grey.png"), Image<glm::vec3>(size.x, size.y, glm::vec3(0.3F))); // 4 samples: 1.2 of them
    const std::string said = sentence(fake(fmt::format("cp {} image.png", file("grey.png").string())));
    EXPECT_TRUE(contains(said, "not a count of light samples")) << said;
}

TEST_F(PovRayFailure, AFullDiskIsNamed) {
    const fs::path disk = file("disk");
    fs::create_directory(disk);
    if (mount("none", disk.c_str(), "tmpfs", 0, "size=128k") != 0) GTEST_SKIP() << "needs the right to mount a small disk";
    setenv("TMPDIR", disk.c_str(), 1);
    try {
        // The scene fits into 128 kB, POV-Ray's state file and image of 256² do not.
        povray::render(overlappingPlates(), {256, 256}, 64);
        ADD_FAILURE() << "rendered on a full disk";
    } catch (const Inconclusive& error) {
        EXPECT_TRUE(contains(error.what(), "disk")) << error.what();
        EXPECT_TRUE(contains(error.what(), "full")) << error.what();
    }
    EXPECT_TRUE(fs::is_empty(disk));
    umount(disk.c_str());
}

TEST_F(PovRayFailure, ATemporaryFolderThatDoesNotExistIsNamed) {
    setenv("TMPDIR", (base_ / "absent").c_str(), 1);
    EXPECT_TRUE(contains(sentence({}), "TMPDIR"));
}

TEST_F(PovRayFailure, TheChildSeesAPrivateHomeAndNoInput) {
    const povray::Options options = fake(fmt::format("env > {}; pwd >> {}; cat >> {}; exit 1", file("env").string(),
                                                     file("env").string(), file("env").string()));
    setenv("SHADOWBENCH_TEST_SECRET", "visible", 1);
    sentence(options);
    unsetenv("SHADOWBENCH_TEST_SECRET");
    const std::string environment = readFile(file("env"));
    EXPECT_TRUE(contains(environment, "HOME=" + temporary().string())) << environment;
    EXPECT_FALSE(contains(environment, "SECRET"));
}

TEST_F(PovRayFailure, TheChildIsLimitedInMemoryFilesAndDumps) {
    const povray::Options options =
        fake(fmt::format("(ulimit -v; ulimit -n; ulimit -c; ulimit -t; ulimit -f) > {}; exit 1", file("limits").string()));
    sentence(options);
    std::istringstream limits(readFile(file("limits")));
    long memory = 0, files = 0, dump = -1, seconds = 0, blocks = 0; // "unlimited" would not be read as a number
    limits >> memory >> files >> dump >> seconds >> blocks;
    EXPECT_GE(memory, 1 << 20); // KiB: POV-Ray needs half a GiB of address space for an empty scene …
    EXPECT_LE(memory, 2 << 20); // … and twenty bytes for each of this one's text do not make it two
    EXPECT_EQ(files, 64);
    EXPECT_EQ(dump, 0);
    EXPECT_EQ(seconds, 31); // 30 s with one thread
    EXPECT_GT(blocks, 0);
}

TEST_F(PovRayFailure, AChildThatTakesAllMemoryIsEnded) {
    // dash keeps a variable in memory: doubled until the address space is full.
    const std::string said = sentence(fake("x=aaaaaaaaaaaaaaaa; while :; do x=$x$x; done"));
    EXPECT_TRUE(contains(said, "Out of space") || contains(said, "killed by signal")) << said;
}

TEST_F(PovRayFailure, ProgressRisesToOne) {
    std::vector<double> seen;
    povray::render(overlappingPlates(), size, 16, {}, [&](double done, std::string_view) { seen.push_back(done); });
    ASSERT_FALSE(seen.empty());
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1.0);
}

TEST(PovRayScene, HoldsNumbersAndOurOwnWordsOnly) {
    const std::string text = povray::sceneText(overlappingPlates(), size, 16);
    const std::set<std::string> ours{"version",
                                     "global_settings",
                                     "assumed_gamma",
                                     "declare",
                                     "T",
                                     "texture",
                                     "pigment",
                                     "rgb",
                                     "finish",
                                     "ambient",
                                     "diffuse",
                                     "brilliance",
                                     "emission",
                                     "camera",
                                     "perspective",
                                     "location",
                                     "direction",
                                     "right",
                                     "up",
                                     "mesh2",
                                     "vertex_vectors",
                                     "face_indices",
                                     "object",
                                     "matrix",
                                     "double_illuminate",
                                     "light_source",
                                     "M0",
                                     "M1"};
    const std::regex word("[A-Za-z_][A-Za-z_0-9]*");
    const std::string words = std::regex_replace(text, std::regex("(^|[^A-Za-z_0-9])[-+]?[0-9.]+(e[-+]?[0-9]+)?"), "$1");
    for (std::sregex_iterator i(words.begin(), words.end(), word), end; i != end; ++i)
        EXPECT_TRUE(ours.contains(i->str())) << i->str();
}

TEST(PovRayScene, HoldsNoStringOfTheUsers) {
    constexpr std::string_view text = R"(
title = "T\" #include \"/etc/passwd\""
camera = { eye = [3.1, 4.2, 7.3], target = [0, 0.6, 0], fovy = 40, near = 0.1, far = 60 }
light = { kind = "rectangle", centre = [0.2, 8.1, 0.3], u = [1.8, 0, 0.1], v = [-0.1, 0, 1.8] }
[[object]]
name = "} #include \"injected.inc\" // injected"
mesh = { box = { size = [2, 1, 1] } }
)";
    const Scene scene = parseScene(text, "injected \"#include\".toml", Profile::Gate);
    ASSERT_TRUE(contains(scene.objects.at(0).name, "#include")); // it was read …
    const std::string written = povray::sceneText(snapshot(scene, 0), size, 16);
    for (const char* part : {"include", "injected", "passwd", "\"", "//"}) EXPECT_FALSE(contains(written, part)) << part;
}

TEST(PovRayScene, RefusesWhatItCannotRender) {
    const Snapshot scene = overlappingPlates();
    for (const int samples : {-1, 0, povray::fewestLightSamples - 1, povray::mostLightSamples + 1})
        EXPECT_THROW(povray::sceneText(scene, size, samples), BadInput) << samples;
    EXPECT_THROW(povray::sceneText(scene, {0, 64}, 16), BadInput);
    Snapshot point = scene;
    point.light.kind = LightKind::Point;
    EXPECT_THROW(povray::sceneText(point, size, 16), BadInput);
    Snapshot broken = scene;
    broken.batches[0].placements[0].world[3].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(povray::sceneText(broken, size, 16), BadInput);
}

} // namespace
} // namespace shadowbench::groundtruth
