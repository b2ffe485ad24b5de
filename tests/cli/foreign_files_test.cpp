// Files of other people, as a user meets them: one line, exit code 2, nothing written.
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

namespace shadowbench {
namespace {

class ForeignFiles : public testing::Test {
protected:
    /// One line on a scene whose mesh is `file`.
    Outcome run(const std::string& file, const std::string& before = "") const {
        folder_.write("own.toml", tinyScene("{ kind = \"point\", centre = [1.7, 6.1, -2.3] }",
                                            "[[object]]\nmesh = { file = \"" + file + "\" }\n"));
        return shell(before + "shadowbench run --quiet --cost none --technique none --scene " + folder_ / "own.toml" +
                     " --out " + folder_ / "out" + " --cache " + folder_ / "cache");
    }
    void expectRefused(const Outcome& outcome, const std::string& why) const {
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
        EXPECT_NE(outcome.output.find(why), std::string::npos) << outcome.output;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
    }

    Folder folder_;
};

TEST_F(ForeignFiles, ThatAreDamagedAreNamed) {
    folder_.write("bad.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                  "0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n"); // it has no vertex 9
    expectRefused(run("bad.ply"), "mesh.file: cannot import mesh " + folder_ / "bad.ply: ");
    expectRefused(run("/etc/passwd"), "it is no .obj, .ply, .gltf or .glb file");
    expectRefused(run("/dev/zero"), "it is a pipe or a device");
}

TEST_F(ForeignFiles, ALimitThatIsNoNumberIsNamed) {
    folder_.write("bad.ply", "");
    expectRefused(run("bad.ply", "SHADOWBENCH_MAX_FILE_MIB=1e3 "),
                  "SHADOWBENCH_MAX_FILE_MIB=\"1e3\": expected a whole number");
}

TEST_F(ForeignFiles, WhatIsHeldAgainstThemIsListed) {
    const Outcome limits = shell("SHADOWBENCH_MAX_TRIANGLES=7 shadowbench list limits");
    EXPECT_EQ(limits.code, 0);
    EXPECT_NE(limits.output.find("SHADOWBENCH_MAX_TRIANGLES\n    limit: 7\n    default: 4000000"), std::string::npos)
        << limits.output;
    EXPECT_NE(limits.output.find("read on this system in a child with limits"), std::string::npos);
    EXPECT_NE(shell("shadowbench list limits --format ids").output.find("SHADOWBENCH_MAX_PIXELS\n"), std::string::npos);
}

} // namespace
} // namespace shadowbench
