// Shaders of technique folders that are broken in many ways: each is one line with its place.
#include "base/one_line.h"
#include "tests/fuzz/tokens.h"
#include "tests/support/message_of.h"
#include "tests/support/stages.h"
#include "tests/support/technique_folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class BrokenShader : public testing::Test {
protected:
    /// What is said when the row is made, without the folder.
    [[nodiscard]] std::string said(const std::string& shader) const {
        folder_.write("resolve.frag", shader);
        testContext();
        const std::string message = test::messageOf<BadInput>([&] { folder_.made(); });
        EXPECT_EQ(message, onOneLine(message));
        const std::string path = (folder_.path() / "").string();
        return message.starts_with(path) ? message.substr(path.size()) : "elsewhere: " + message;
    }
    /// With `line` as the eighth, between the lines of main().
    [[nodiscard]] std::string saidOf(const std::string& line) const {
        return said(replaced(mapShader, "    visibility =", line + "\n    visibility ="));
    }

    WrittenTechnique folder_;
};

TEST_F(BrokenShader, AnyWrongLineIsToldByItsNumber) {
    for (const char* line : {"float a = b;",
                             "float a = vec3(1.0);",
                             "int a = 1.5;",
                             "vec2 a = vec3(1.0).xyzw;",
                             "a();",
                             "float a = sin();",
                             "return 1.0;",
                             "float receiver = 1.0; float receiver = 2.0;",
                             "const float a = gl_FragCoord.x; float b[int(a)];",
                             "depths = 1;",
                             "float a = texture(depths, vec2(0.5));",
                             "mat4 a = mat3(1.0) * vec4(1.0);",
                             "if (1) {}",
                             "while (1) {}",

                             "break;",
                             "discard 1;",
                             "float a[3] = float[2](1.0, 2.0);",
                             "int a = 1 << 1.0;",
                             "bool a = 1.0 && true;",

                             "float 1a = 2.0;",
                             "float a = 1.0",
                             "float a = (1.0;",
                             "float a = 1.0);",
                             "@",
                             "\"text\"",
                             "goto a;",
                             "float gl_mine = 1.0;",
                             "switch (1.0) {}",
                             "struct S { float a; }; S s = 1.0;",
                             "float a = receiver.nothing;",
                             "receiver.position();",
                             "gl_FragCoord.x = 1.0;",
                             "float a = 0x;",
                             "float a = 1.0.0;",
                             "#error mine",
                             "#define",
                             "#if 1 +",
                             "#version 330",
                             "#include <gl/receiver.glsl>"}) {
        const std::string message = saidOf(line);
        // What an end of a line lacks is found on the next one.
        EXPECT_TRUE(message.starts_with("resolve.frag:8: ") || message.starts_with("resolve.frag:9: ")) << line << "\n"
                                                                                                        << message;
        EXPECT_GT(message.size(), 24U) << message;
    }
}

TEST_F(BrokenShader, WhatIsWrongWithAWholeFileIsTold) {
    for (const auto& [shader, says] : std::vector<std::pair<std::string, std::string>>{
             {"", "resolve.frag:0: error: "},
             {"out float visibility;\n", "resolve.frag: error: "},
             {"out float visibility;\nvoid main() { visibility = 1.0;\n", "resolve.frag:2: "},
             {"out float visibility;\n#if 1\nvoid main() { visibility = 1.0; }\n", "resolve.frag:"},
             {"out float visibility;\nfloat f(float x);\nvoid main() { visibility = f(1.0); }\n", "resolve.frag: error: "},
             {"out float visibility;\nfloat f(float x) { return f(x); }\nvoid main() { visibility = f(1.0); }\n",
              "resolve.frag"},
             {"in float casterDepth;\nout float visibility;\nvoid main() { visibility = casterDepth; }\n",
              "resolve.frag: error: "},
             {"in float visibility;\nout float visibility;\nvoid main() {}\n", "resolve.frag:2: "},
             {"#extension GL_MINE_none : require\nout float visibility;\nvoid main() {}\n", "resolve.frag:1: "},
             {std::string(1000, '\x01') + "\n", "resolve.frag:1: "},
             {"#define A B B B B\n#define B 1.0 +\nout float v;\nvoid main() { v = A; }\n", "resolve.frag:4: "}}) {
        const std::string message = said(shader);
        EXPECT_TRUE(message.starts_with(says)) << shader << "\n" << message;
        EXPECT_GT(message.size(), says.size() + 8) << message;
    }
}

TEST_F(BrokenShader, AWarningBeforeIsNotTheError) {
    const std::string warned = "float unset;\n    float other = unset * 2.0;\n    visibility = other + nothing;";
    EXPECT_NE(saidOf(warned).find(": error: `nothing' undeclared"), std::string::npos) << saidOf(warned);
}

TEST_F(BrokenShader, ANameThatIsNotThereIsToldWithNearOnesThatTheShaderMayHaveMeant) {
    const auto near = [&](const std::string& expression) {
        const std::string message = saidOf("float a = " + expression + ";");
        const std::size_t begin = message.find(" (");
        return begin == std::string::npos ? "none of: " + message : message.substr(begin);
    };
    EXPECT_EQ(near("float(MAPP)"), " (did you mean \"MAP\"?)"); // a parameter
    EXPECT_EQ(near("unitDepthFromWrold.x"),
              " (did you mean \"unitDepthFromWorld\" or \"eyeDepthFromWorld\" or \"depthFromWorld\"?)"); // a uniform
    EXPECT_EQ(near("reciever.position.x"), " (did you mean \"receiver\" or \"Receiver\"?)");         // a variable of its own
    EXPECT_EQ(near("shadowTset(depths, testedPoint(receiver))"), " (did you mean \"shadowTest\"?)"); // a function of ours
    EXPECT_EQ(saidOf("float a = nothing;"), "resolve.frag:8: error: `nothing' undeclared");
    const std::string longName(900, 'a');
    EXPECT_EQ(saidOf("float " + longName + "b = " + longName + ";"), "resolve.frag:8: error: `" + longName + "' undeclared");
}

TEST_F(BrokenShader, AnErrorOfTypesSaysThoseOfParametersInItsLine) {
    folder_.write("technique.toml", replaced(mapToml, "[target.depths]",
                                             "[parameter.radius]\ndefault = 2\nrange = [0.5, 8]\nmeaning = \"m\"\n"
                                             "[parameter.taps]\ndefault = \"4\"\nchoices = [\"4\", \"8\"]\nmeaning = \"m\"\n"
                                             "[target.depths]"));
    const std::string file = (folder_.path() / "technique.toml").string();
    for (const auto& [line, says] :
         {std::pair("int a = RADIUS;",
                    "; RADIUS is the float 2.00000000, as a number at " + file + ":10 has a decimal point"),
          std::pair("float a = MAP % 2.0;", "; MAP is the int 1024, as no number at " + file + ":5 has a decimal point"),
          std::pair("int a[RADIUS];",
                    "; RADIUS is the float 2.00000000, as a number at " + file + ":10 has a decimal point"),
          std::pair("vec2 a = pow(TAPS, RADIUS, 1.0);", "; RADIUS is the float 2.00000000, as a number at " + file +
                                                            ":10 has a decimal point; TAPS is the int 4, as no number at " +
                                                            file + ":14 has a decimal point")}) {
        const std::string message = saidOf(line);
        EXPECT_TRUE(message.starts_with("resolve.frag:8: error: ")) << message;
        EXPECT_TRUE(message.ends_with(says)) << message;
    }
    EXPECT_EQ(saidOf("int a = 1.5;").find(';'), std::string::npos) << saidOf("int a = 1.5;");
}

TEST_F(BrokenShader, IncludesLeadToFilesOfTheFolderOrOurs) {
    const auto of = [&](const std::string& line) { return said(line + "\n" + mapShader); };
    for (const char* away : {"../resolve.frag", "/etc/passwd", "gl/../gl/receiver.glsl", "./more.glsl", "more.glsl/", ""})
        EXPECT_TRUE(of(fmt::format("#include \"{}\"", away))
                        .starts_with(fmt::format("resolve.frag:1: there is no shader \"{}\"", away)))
            << of(fmt::format("#include \"{}\"", away));
    EXPECT_TRUE(
        of("  #  include \"gl/reciever.glsl\"")
            .starts_with("resolve.frag:1: there is no shader \"gl/reciever.glsl\" (did you mean \"gl/receiver.glsl\"?)"))
        << of("  #  include \"gl/reciever.glsl\"");
    EXPECT_TRUE(said("float a\n" + mapShader).starts_with("resolve.frag: before or in its #include of gl/"))
        << said("float a\n" + mapShader);
    folder_.write("more.glsl", "float more() { return less; }\n");
    EXPECT_TRUE(of("#include \"more.glsl\"").starts_with("more.glsl:1: error: `less' undeclared"));
    folder_.write("more.glsl", "\n#include \"other.glsl\"\n");
    EXPECT_TRUE(of("#include \"more.glsl\"").starts_with("more.glsl:2: there is no shader \"other.glsl\""));
}

TEST_F(BrokenShader, FilesThatIncludeEachOtherAreIncludedOnce) {
    folder_.write("a.glsl", "#include \"b.glsl\"\nfloat a() { return 1.0; }\n");
    folder_.write("b.glsl", "#include \"a.glsl\"\n#include \"resolve.frag\"\nfloat b() { return 1.0; }\n");
    folder_.write("resolve.frag", "#include \"a.glsl\"\n" + mapShader);
    EXPECT_NO_THROW(folder_.made());
}

TEST_F(BrokenShader, UniformsThatNothingSetsOrOfAnotherTypeAreToldByTheirLine) {
    const auto of = [&](const std::string& declaration, const std::string& use) {
        return said(replaced(replaced(mapShader, "uniform sampler2DShadow depths;", declaration),
                             "shadowTest(depths, testedPoint(receiver))", use));
    };
    EXPECT_EQ(of("uniform float kernel;", "kernel"),
              "resolve.frag:3: nothing sets the uniform \"kernel\"; parameters are macros in capitals");
    EXPECT_EQ(
        of("uniform sampler2DShadow depth;", "texture(depth, vec3(0.5))"),
        "resolve.frag:3: nothing sets the uniform \"depth\" (did you mean \"depths\"?); parameters are macros in capitals");
    EXPECT_EQ(of("uniform ivec3 eye;", "float(eye.x)"), "resolve.frag:3: the uniform \"eye\" is vec3");
    EXPECT_EQ(of("uniform vec2 eye;", "eye.x"), "resolve.frag:3: the uniform \"eye\" is vec3, not vec2");
    EXPECT_EQ(of("uniform vec3 depths;", "depths.x"), "resolve.frag:3: the uniform \"depths\" is sampler2DShadow, not vec3");
    EXPECT_EQ(of("uniform sampler2D depths;", "texture(depths, vec2(0.5)).r"),
              "resolve.frag:3: the uniform \"depths\" is sampler2DShadow, not sampler2D");
    EXPECT_EQ(of("layout(r32f) uniform image2D depths;", "imageLoad(depths, ivec2(0)).r"),
              "resolve.frag:3: images are stored into by compute passes alone: declare a sampler");
    EXPECT_EQ(of("uniform sampler2D previous_depths;", "texture(previous_depths, vec2(0.5)).r").substr(0, 70),
              std::string("resolve.frag:3: nothing sets the uniform \"previous_depths\"; parameters").substr(0, 70));
    EXPECT_NE(of("uniform Mine { float a; };", "a").find("nothing sets the uniform"), std::string::npos);
    EXPECT_NE(
        of("uniform float eyes[3];", "eyes[int(gl_FragCoord.x)]").find("resolve.frag:3: nothing sets the uniform \"eyes\""),
        std::string::npos);
}

TEST_F(BrokenShader, APassThatReadsWhatItWritesIsToldByItsLine) {
    folder_.write("technique.toml",
                  replaced(replaced(mapToml, "[[pass]]\nname = \"resolve\"",
                                    "[[pass]]\nname = \"again\"\ndraw = \"screen\"\nfragment = \"again.frag\"\nto = "
                                    "\"twice\"\n[[pass]]\nname = \"resolve\""),
                           "[[pass]]", "[target.twice]\nformat = \"R32F\"\nsize = \"image\"\n[[pass]]"));
    folder_.write("again.frag",
                  "out float v;\nuniform sampler2D twice;\nvoid main() { v = texture(twice, vec2(0.5)).r; }\n");
    EXPECT_EQ(said(mapShader), "again.frag:2: the pass \"again\" reads twice, which it writes; write another target");
}

/// What `tools/fuzz` does with the description, for the shaders: libFuzzer has no context of OpenGL.
TEST_F(BrokenShader, ChangedAtRandomIsTakenOrOneLine) {
    testContext();
    int taken = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        folder_.write("resolve.frag", fuzz::changed(mapShader, seed));
        try {
            folder_.made();
            ++taken;
        } catch (const BadInput& error) {
            const std::string message = onOneLine(error.what());
            EXPECT_EQ(message.find(folder_.path().string()), 0U) << message;
        }
    }
    EXPECT_GT(taken, 2);
    EXPECT_LT(taken, 250);
}

} // namespace
} // namespace shadowbench
