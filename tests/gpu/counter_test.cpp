// How often lanes take loops and branches of shaders written here, counted while they draw.
#include "gpu/counter.h"

#include "gpu/executed.h"
#include "gpu/marks.h"
#include "gpu/observer.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "tests/gpu/shaders.h"

#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::gpu {
namespace {

using Sums = std::vector<std::uint64_t>;

constexpr int side = 64;

class Counted : public Compiling {
protected:
    void SetUp() override {} // compiles in some tests alone

    std::string shader(const std::string& body, const std::string& functions = "") const {
        return "out vec4 c;\nuniform int n;\n" + functions +
               "\nvoid main() {\n    int x = int(gl_FragCoord.x), y = int(gl_FragCoord.y); float v = 0.0;\n    " + body +
               "\n    c = vec4(v + 0.0 * float(n));\n}\n";
    }

    /// What drawing the body over the target passes.
    Use use(const std::string& text, int n = 0) {
        Counter counter;
        gl::Program program = gl::Program::screenFromText("test.frag", text);
        if (program.uses("n")) program.set("n", n);
        Observer observer(&counter);
        target_.bind();
        program.drawScreen();
        return observer.take().at(0);
    }

    /// Of each pixel, as all take the same way.
    Sums each(const std::string& body, const std::string& functions = "", int n = 0) {
        Sums passes = use(shader(body, functions), n).passes.quads;
        for (std::uint64_t& sum : passes) {
            EXPECT_EQ(sum % (side / 2 * side / 2), 0U);
            sum /= side / 2 * side / 2;
        }
        return passes;
    }

    Image<float> drawn(const std::string& text, bool counted) {
        std::unique_ptr<Counter> counter = counted ? std::make_unique<Counter>() : nullptr;
        const gl::Program program = gl::Program::screenFromText("test.frag", text);
        Observer observer(counter.get());
        target_.clearColour(0, glm::vec4(-7));
        target_.bind();
        program.drawScreen();
        EXPECT_EQ(observer.take().at(0).passes.empty(), !counted);
        return target_.readFloat(0);
    }

    std::unique_ptr<gl::Context> context_ = gl::Context::create();
    gl::Texture colour_{gl::Format::R32F, {side, side}};
    gl::RenderTarget target_{&colour_};
};

TEST_F(Counted, LaneIOfARowLoopsITimes) {
    const WavePasses passes = use(shader("for (int i = 0; i < x; ++i) v += sqrt(v);")).passes;
    std::uint64_t tiles = 0, quads = 0; // the last lane of each
    for (int last = 7; last < side; last += 8) tiles += static_cast<std::uint64_t>(last);
    for (int last = 1; last < side; last += 2) quads += static_cast<std::uint64_t>(last);
    EXPECT_EQ(passes.waves64, (Sums{64, 8 * tiles}));
    EXPECT_EQ(passes.waves32, (Sums{128, 16 * tiles}));
    EXPECT_EQ(passes.quads, (Sums{1024, 32 * quads}));
    EXPECT_EQ(passes.longest64, (Sums{1, side - 1}));
}

TEST_F(Counted, EachKindOfStatementHasItsPlaces) {
    EXPECT_EQ(each("for (int i = 0; i < 3; ++i) v += 1.0;"), (Sums{1, 3}));
    EXPECT_EQ(each("for (int i = 0; i < 3; ++i) { for (int j = 0; j < i; ++j) v += 1.0; }"), (Sums{1, 3, 3}));
    EXPECT_EQ(each("int i = 0; while (i < 5) { ++i; }"), (Sums{1, 5}));
    EXPECT_EQ(each("int i = 9; do { ++i; } while (i < 5);"), (Sums{1, 1}));
    EXPECT_EQ(each("int i = 0; do ++i; while (i < 4);"), (Sums{1, 4}));
    EXPECT_EQ(each("if (n == 0) v = 1.0; else v = 2.0;"), (Sums{1, 1, 0}));
    EXPECT_EQ(each("if (n == 1) v = 1.0; else if (n == 0) v = 2.0; else v = 3.0;"), (Sums{1, 0, 1, 1, 0}));
    EXPECT_EQ(each("v = n == 0 ? 1.0 : 2.0; bool both = n == 0 && x > 3 || y > 2; v += float(both);"), Sums{})
        << "neither loop nor branch: nothing is counted";
}

TEST_F(Counted, ASwitchCountsItsLabels) {
    const std::string body = "switch (n) { case 0: v = 1.0; case 1: v += 2.0; break; case 2: { v = 3.0; break; } "
                             "default: v = 4.0; }";
    EXPECT_EQ(each(body, "", 0), (Sums{1, 1, 1, 0, 0})) << "which falls through";
    EXPECT_EQ(each(body, "", 1), (Sums{1, 0, 1, 0, 0}));
    EXPECT_EQ(each(body, "", 2), (Sums{1, 0, 0, 1, 0}));
    EXPECT_EQ(each(body, "", 9), (Sums{1, 0, 0, 0, 1}));
}

TEST_F(Counted, WhatFollowsAWayOutHasAPlaceOfItsOwn) {
    EXPECT_EQ(each("if (n == 1) return; v = 1.0;"), (Sums{1, 0, 1}));
    EXPECT_EQ(each("if (n == 0) { c = vec4(1); return; } v = 1.0;"), (Sums{1, 1, 0}));
    EXPECT_EQ(each("for (int i = 0; i < 6; ++i) { if (i < 4) continue; v += 1.0; }"), (Sums{1, 6, 4, 2}));
    EXPECT_EQ(each("for (int i = 0; i < 6; ++i) { v += 1.0; if (i == 2) break; v += 2.0; }"), (Sums{1, 3, 1, 2}));
    EXPECT_EQ(each("for (int i = 0; i < 6; ++i) { if (i == 2) break; } v = 2.0;"), (Sums{1, 3, 1}))
        << "what breaks a loop goes on behind it";
    EXPECT_EQ(each("for (int i = 0; i < 6; ++i) { if (i == n) return; } v = 2.0;", "", 2), (Sums{1, 3, 1, 0}));
    EXPECT_EQ(each("if (n == 0) { if (n == 1) discard; v = 1.0; } v += 2.0;"), (Sums{1, 1, 0, 1, 1}));
}

TEST_F(Counted, FunctionsAndMacrosAreCountedWhereTheyStand) {
    EXPECT_EQ(
        each("v = sum(2) + sum(5);", "float sum(int m) { float s = 0.0; for (int i = 0; i < m; ++i) s += 1.0; return s; }"),
        (Sums{1, 7}))
        << "two calls, one place";
}

TEST_F(Counted, AMacroThatHoldsALoopIsOne) {
    EXPECT_EQ(each("REPEAT(4, v += 1.0)", "#define REPEAT(m, what) for (int i = 0; i < m; ++i) what;"), (Sums{1, 4}));
}

TEST_F(Counted, ADiscardedLaneIsCountedUpToThere) {
    const WavePasses passes = use(shader("for (int i = 0; i < 3; ++i) v += 1.0; if (x < 32) discard; v += 1.0;")).passes;
    EXPECT_EQ(passes.waves64, (Sums{64, 3 * 64, 32, 32}));
}

TEST_F(Counted, FragmentsOfOnePixelAddUpAndTargetsAreApart) {
    Counter counter;
    const gl::Program program =
        gl::Program::screenFromText("test.frag", "out vec4 c;\nvoid main() { c = vec4(0); "
                                                 "for (int i = 0; i < int(gl_FragCoord.y); ++i) c.x += 1.0; }\n");
    const gl::Texture small{gl::Format::R8, {8, 8}};
    const gl::RenderTarget other{&small};
    Observer observer(&counter);
    target_.bind();
    program.drawScreen();
    program.drawScreen();
    other.bind();
    program.drawScreen();
    const std::vector<Use> uses = observer.take();
    ASSERT_EQ(uses.size(), 2U);
    EXPECT_EQ(uses[0].passes.waves64.at(0), 2U * 64);
    EXPECT_EQ(uses[1].passes.waves64, (Sums{1, 7}));
    EXPECT_EQ(uses[1].passes.waves32, (Sums{2, 3 + 7}));
    EXPECT_TRUE(observer.take().empty());
}

TEST_F(Counted, ADispatchCountsItsInvocations) {
    Counter counter;
    const gl::Program program = gl::Program::compute("shared/maps/bin_pixels.comp");
    Observer observer(&counter);
    program.dispatch(100);
    const Use use = observer.take().at(0);
    EXPECT_EQ(use.passes.waves64.at(0), 2U) << "two groups of 64";
    EXPECT_EQ(use.passes.waves32.at(0), 4U);
}

TEST_F(Counted, MarksChangeNoBit) {
    const std::string body = "for (int i = 0; i < x; ++i) { v += sqrt(float(i * y)) * 0.37; if (v > 900.0) break; "
                             "if ((i & y) == 3) continue; v -= 0.1 * sin(v); }\n"
                             "if (((x ^ y) & 7) == 5) discard; if (y > 50) { c = vec4(v); return; }";
    const std::string text = "out vec4 c;\nvoid main() {\n    int x = int(gl_FragCoord.x), y = int(gl_FragCoord.y); "
                             "float v = 0.0;\n    " +
                             body + "\n    c = vec4(v * 1.1);\n}\n";
    const Image<float> with = drawn(text, true), without = drawn(text, false);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) ASSERT_EQ(with(x, y), without(x, y)) << x << ", " << y;
}

TEST_F(Counted, ALoopIsOfConstantLengthByItsTest) {
    const auto hasInner = [](const std::string& body) {
        return marked({Stage::Fragment, "test",
                       "#version 450 core\nuniform int n;\nconst int most = 4;\nvoid main() { " + body + " }\n"})
            .hasInner;
    };
    EXPECT_TRUE(hasInner("for (int i = 0; i < 2 * most; ++i) {}"));
    EXPECT_FALSE(hasInner("for (int i = 0; i < n; ++i) {}"));
    EXPECT_FALSE(hasInner("for (int i = 0; i < n; ++i) for (int j = 0; j < i; ++j) {}"));
    EXPECT_TRUE(hasInner("for (int i = 0; i < most; ++i) for (int j = 0; j < i; ++j) {}"));
    EXPECT_FALSE(hasInner("int i = 0; while (i < most) ++i;"));
}

TEST_F(Counted, ABrokenShaderIsRefused) {
    EXPECT_THROW((void)marked({Stage::Fragment, "test", "#version 450 core\nvoid main() { if (true) {"}), BadInput);
    EXPECT_THROW((void)marked({Stage::Fragment, "test", "#version 450 core\n#if 1\nvoid main() {}\n"}), BadInput);
}

TEST_F(Counted, TheSourceIsStillTheOneThatWasGiven) {
    const std::string text = shader("if (n == 0) v = 1.0;");
    EXPECT_TRUE(use(text).pipeline.shaders.at(1).text.ends_with(text));
}

class Weighed : public Counted {
protected:
    void SetUp() override { Compiling::SetUp(); }

    Executed weighed(const Use& use) const {
        const Compiler& compiler = compilerFor("navi21");
        for (const StageFigures& figures : compiler.compile(use.pipeline))
            if (figures.stage == Stage::Fragment) {
                throughput_ = static_cast<double>(figures.of("Inverse Throughput"));
                return executed(figures, use.passes.empty() ? std::vector<Busy>() : compiler.busyOfMarks(use.pipeline),
                                use.passes);
            }
        throw InternalError("the pipeline has no fragment shader");
    }

    mutable double throughput_ = 0; // of the last one weighed
};

TEST_F(Weighed, DivergenceAloneCosts) {
    // Half of the pixels take the branch in both. Its work is not the same for all lanes, so that it stays a branch.
    const std::string text =
        shader("if (n == 0 ? ((x + y) & 1) == 0 : x < 32) { for (int i = 0; i < 40; ++i) v += sqrt(v + float(x)); }");
    const Use checkers = use(text, 0), halves = use(text, 1);
    EXPECT_EQ(checkers.pipeline.digest(), halves.pipeline.digest());
    EXPECT_EQ(checkers.passes.waves64.at(1), 64U);
    EXPECT_EQ(halves.passes.waves64.at(1), 32U);
    const Executed all = weighed(checkers), half = weighed(halves);
    EXPECT_GT(all.cycles64, 1.8 * half.cycles64);
    EXPECT_GT(all.cycles32, 1.8 * half.cycles32);
}

TEST_F(Weighed, ALoopCostsItsRounds) {
    const std::string text = shader("for (int i = 0; i < n; ++i) v += sqrt(v + float(x));");
    const double none = weighed(use(text, 100)).cycles64, once = weighed(use(text, 200)).cycles64,
                 twice = weighed(use(text, 300)).cycles64;
    EXPECT_NEAR((twice - once) / (once - none), 1, 0.001);
    EXPECT_GT(once, throughput_) << "the compiler guesses eight";
}

TEST_F(Weighed, AThousandthMoreIsSeen) {
    const std::string text = shader("for (int i = 0; i < n + (x == 0 && y == 0 ? 8 : 0); ++i) v += sqrt(v + float(x));");
    const std::string less = shader("for (int i = 0; i < n; ++i) v += sqrt(v + float(x));");
    EXPECT_EQ(use(text, 100).passes.waves64.at(1), 64U * 100 + 8);
    EXPECT_EQ(use(less, 100).passes.waves64.at(1), 64U * 100);
}

TEST_F(Weighed, WithoutLoopOrBranchItIsTheCompilersFigure) {
    const Executed all = weighed(use(shader("v = sqrt(float(x)) + (y > 3 ? sin(float(y)) : 1.0);")));
    EXPECT_EQ(all.cycles32, throughput_);
    EXPECT_EQ(all.cycles64, throughput_);
}

TEST_F(Weighed, ALoopThatMarksKeepFromBeingUnrolledIsAsItWas) {
    // So much work in each of 48 rounds that a mark's store is too much for the compiler to unroll them.
    const gl::ShaderSource source =
        gl::loadShader("filtered/columns.comp", {{"REACH", "3"}, {"WIDTH", "7.0"}, {"PACK", "1"}, {"FORMAT", "rgba32f"}});
    const Pipeline pipeline{{{Stage::Compute, "columns", source.text}}, {}};
    const StageFigures figures = compilerFor("navi21").compile(pipeline).at(0);
    const std::vector<Busy> marks = compilerFor("navi21").busyOfMarks(pipeline);
    ASSERT_EQ(marks.size(), 8U) << "main, its way out and what follows, and five loops";
    const double unrolled = marks[0][Part::Vector] + 0.75 * marks[2][Part::Vector]; // as the compiler guesses that way out
    EXPECT_NEAR(unrolled / figures.guessed[Part::Vector], 1, 0.05);
    EXPECT_EQ(marks[2][Part::BufferReads], 0) << "the array stays in registers";
}

TEST_F(Weighed, TheGuessIsTheCompilersOwn) {
    for (const char* body :
         {"for (int i = 0; i < n; ++i) v += sqrt(v + float(x));", "if (x > n) v = sqrt(v + float(y)) * sin(v);",
          "for (int i = 0; i < n; ++i) for (int j = 0; j < x; ++j) v += sqrt(v);"}) {
        for (const StageFigures& figures : compilerFor("navi21").compile(use(shader(body)).pipeline)) {
            const auto throughput = static_cast<double>(figures.of("Inverse Throughput"));
            if (figures.stage == Stage::Vertex) continue;
            EXPECT_NEAR(cyclesOf(figures.guessed, figures.waves) / throughput, 1, 0.15) << body;
        }
    }
}

TEST_F(Weighed, TwiceIsTheSame) {
    const std::string text = shader("for (int i = 0; i < x; ++i) { if (((i ^ y) & 3) == 1) continue; v += sqrt(v); }");
    const Executed first = weighed(use(text)), second = weighed(use(text));
    EXPECT_EQ(first.cycles32, second.cycles32);
    EXPECT_EQ(first.cycles64, second.cycles64);
    EXPECT_EQ(first.longest64, second.longest64);
}

} // namespace
} // namespace shadowbench::gpu
