// What an observer sees of draws that this test makes.
#include "gpu/observer.h"

#include "base/error.h"
#include "techniques/contract/pass.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::gpu {
namespace {

class Observed : public testing::Test {
protected:
    void draw() const {
        target_.bind();
        program_.drawScreen();
    }

    std::unique_ptr<gl::Context> context_ = gl::Context::create();
    gl::Texture colour_{gl::Format::RG16F, {8, 8}}, depth_{gl::Format::Depth32F, {8, 8}};
    gl::RenderTarget target_{&colour_, &depth_};
    gl::Program program_ = gl::Program::screenFromText("white.frag", "out vec4 c;\nvoid main() { c = vec4(1); }\n");
};

TEST_F(Observed, PassesHaveTheirPipelinesAndHowOftenTheyDraw) {
    Observer observer;
    {
        const techniques::Pass pass("blur", nullptr);
        draw();
        draw();
        glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_TRUE);
        draw();
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    draw();
    const std::vector<Use> uses = observer.take();
    ASSERT_EQ(uses.size(), 3U);
    EXPECT_EQ(uses[0].pass, "blur");
    EXPECT_EQ(uses[0].draws, 2U);
    EXPECT_EQ(uses[1].pass, "blur");
    EXPECT_EQ(uses[1].pipeline.state.colours.at(0).writeMask, 13U);
    EXPECT_EQ(uses[2].pass, "");
    EXPECT_EQ(uses[2].pipeline.digest(), uses[0].pipeline.digest());
    EXPECT_TRUE(observer.take().empty());
}

TEST_F(Observed, APipelineIsSourcesAndState) {
    Observer observer;
    draw();
    const Pipeline pipeline = observer.take().at(0).pipeline;
    ASSERT_EQ(pipeline.shaders.size(), 2U);
    EXPECT_EQ(pipeline.shaders[0].name, "gl/screen.vert");
    EXPECT_EQ(pipeline.shaders[1].name, "white.frag");
    EXPECT_TRUE(pipeline.shaders[1].text.starts_with("#version 450 core\n"));
    EXPECT_TRUE(pipeline.shaders[1].text.ends_with("void main() { c = vec4(1); }\n"));
    EXPECT_EQ(pipeline.state.topology, static_cast<unsigned>(GL_TRIANGLES));
    ASSERT_EQ(pipeline.state.colours.size(), 1U);
    EXPECT_EQ(pipeline.state.colours[0].format, static_cast<unsigned>(GL_RG16F));
    EXPECT_FALSE(pipeline.state.colours[0].blends);
    EXPECT_EQ(pipeline.state.depthFormat, static_cast<unsigned>(GL_DEPTH_COMPONENT32F));
    EXPECT_FALSE(pipeline.state.depthTest);
    EXPECT_TRUE(pipeline.state.attributes.empty());
}

TEST_F(Observed, ATargetCountsAgainWhenAnotherOneWasDrawnInto) {
    const gl::Texture small{gl::Format::R8, {4, 2}};
    const gl::RenderTarget other{&small};
    Observer observer;
    draw();
    draw(); // into the same
    other.bind();
    program_.drawScreen();
    draw();
    const std::vector<Use> uses = observer.take();
    ASSERT_EQ(uses.size(), 2U);
    EXPECT_EQ(uses[0].draws, 3U);
    EXPECT_EQ(uses[0].extents, (Extents{{{8, 8}, 2}}));
    EXPECT_EQ(uses[1].extents, (Extents{{{4, 2}, 1}}));
}

TEST_F(Observed, WhatIsClearedAndReadBackIsOfItsPass) {
    Observer observer;
    {
        const techniques::Pass pass("blur", nullptr);
        target_.clearColour(0, glm::vec4(0));
        target_.clearColour(0, glm::vec4(1));
        target_.clearDepth(1);
    }
    (void)target_.readVec4(0);
    const std::vector<Move> moves = observer.takeMoves();
    ASSERT_EQ(moves.size(), 3U);
    EXPECT_EQ(moves[0].pass, "blur");
    EXPECT_EQ(moves[0].kind, MoveKind::Clear);
    EXPECT_EQ(moves[0].format, static_cast<unsigned>(GL_RG16F));
    EXPECT_EQ(moves[0].extents, (Extents{{{8, 8}, 2}}));
    EXPECT_EQ(moves[1].format, static_cast<unsigned>(GL_DEPTH_COMPONENT32F));
    EXPECT_EQ(moves[2].pass, "");
    EXPECT_EQ(moves[2].kind, MoveKind::ReadBack);
    EXPECT_EQ(name(moves[2].kind), "read back");
    EXPECT_TRUE(observer.takeMoves().empty());
}

TEST_F(Observed, NothingIsInTheWayOfACallOtherwise) {
    const auto call = glDrawArrays;
    {
        const Observer observer;
        EXPECT_NE(glDrawArrays, call);
        EXPECT_THROW(Observer(), InternalError);
    }
    EXPECT_EQ(glDrawArrays, call);
    draw();
    context_->check("drawing");
}

TEST_F(Observed, DrawsDrawAndNoErrorIsLeft) {
    const Observer observer;
    target_.clearColour(0, glm::vec4(0));
    draw();
    EXPECT_EQ(target_.readVec4(0)(3, 3).x, 1.0F);
    context_->check("observing");
}

} // namespace
} // namespace shadowbench::gpu
