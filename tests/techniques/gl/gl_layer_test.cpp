// Programs, textures, the G-buffer and the counters.
#include "base/error.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/counters.h"
#include "tests/support/message_of.h"
#include "tests/support/stages.h"

#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace shadowbench {
namespace {

/// "file:number" of the line of the shader `file` that has `text` in it.
std::string lineWith(const std::string& file, const std::string& text) {
    const gl::ShaderSource source = gl::loadShader(file, {});
    std::istringstream lines(source.text);
    std::string line;
    for (std::size_t i = 0; std::getline(lines, line); ++i)
        if (line.find(text) != std::string::npos) return source.origin[i];
    ADD_FAILURE() << file << " has no line with " << text;
    return "";
}

TEST(Program, ACompileErrorNamesFileAndLineOfTheSource) { // in a file with includes before that line
    testContext();
    try {
        gl::Program::screen("filtered/pcf/pcf.frag", {{"KERNEL", "nonsense"}});
        FAIL() << "compiled";
    } catch (const InternalError& error) {
        const std::string line = lineWith("filtered/pcf/pcf.frag", "const int taps = KERNEL");
        EXPECT_NE(std::string(error.what()).find(line), std::string::npos) << error.what();
    }
}

TEST(Program, AMissingShaderIsNamed) {
    testContext();
    EXPECT_THROW(gl::Program::screen("no/such.frag"), InternalError);
}

TEST(Program, ASecondStageThatFailsLeavesNoFirstOne) {
    testContext();
    const auto next = [] {
        const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
        glDeleteShader(shader);
        return shader;
    };
    const GLuint before = next();
    EXPECT_THROW(gl::Program::screenFromText("x.frag", "nonsense", {}), InternalError);
    const GLuint after = next();
    for (GLuint shader = before; shader < after; ++shader) {
        GLint kind = 0; // stays where there is no such shader
        glGetShaderiv(shader, GL_SHADER_TYPE, &kind);
        EXPECT_EQ(kind, 0) << shader;
    }
    gl::Context::current().discardErrors();
}

TEST(Program, SaysWhichSamplersTakeTextures) {
    testContext();
    gl::Program program = gl::Program::screenFromText("x.frag",
                                                      "uniform samplerCube sky;\nout vec4 o;\n"
                                                      "void main() { o = texture(sky, vec3(1)); }\n",
                                                      {});
    EXPECT_EQ(test::messageOf<InternalError>([&] {
                  program.set("sky", gl::Texture(gl::Format::R32F, {1, 1}));
              }),
              "gl/screen.vert + x.frag: sky is no sampler of a 2D texture, an array of them or a buffer");
}

TEST(Program, AMisspeltUniformIsAnError) {
    testContext();
    gl::Program program = gl::Program::screen("shared/sampling/mean.frag");
    EXPECT_THROW(program.set("cuont", 1.0F), InternalError);
    EXPECT_NO_THROW(program.set("count", 1.0F));
}

TEST(Program, EachIncludeIsTakenOnceAndLinesKeepTheirOrigin) {
    const gl::ShaderSource source = gl::loadShader("soft/pcss/pcss.frag", {{"SEARCH_TAPS", "4"}});
    EXPECT_EQ(source.origin[0], "soft/pcss/pcss.frag:0");
    const auto count = [&](const std::string& line) {
        std::size_t found = 0;
        for (std::size_t at = source.text.find(line); at != std::string::npos; at = source.text.find(line, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("struct LightReceiver {"), 1U);
    EXPECT_EQ(count("#include"), 0U);
    for (const char* file : {"soft/pcss/pcss.frag", "shared/filters/pcss.glsl", "shared/filters/blocker_search.glsl"})
        EXPECT_TRUE(source.files.contains(file)) << file;
    EXPECT_FALSE(source.files.contains("shared/filters/pcf.glsl"));
}

TEST(Context, KnowsOfWhichFilesTheShadersAreThatWereCompiled) {
    testContext();
    std::set<std::string>& files = gl::Context::current().shaderFiles();
    files.clear();
    (void)gl::loadShader("soft/pcss/pcss.frag", {});
    EXPECT_TRUE(files.empty()) << "read, and not compiled";
    const gl::Program program = gl::Program::screen("shared/maps/single_map.frag");
    for (const char* file :
         {"gl/screen.vert", "shared/maps/single_map.frag", "shared/maps/light_space.glsl", "gl/tangents.glsl"})
        EXPECT_TRUE(files.contains(file)) << file;
    EXPECT_FALSE(files.contains("soft/pcss/pcss.frag"));
}

TEST(Memory, BytesAreThoseOfTexturesAndBuffersAlive) {
    testContext();
    const std::uint64_t before = gl::Context::current().tally().bytes;
    {
        const gl::Texture depth(gl::Format::Depth32F, {1024, 1024});
        const gl::Texture history(gl::Format::RG16F, {100, 50});
        EXPECT_EQ(gl::Context::current().tally().bytes - before, 1024U * 1024 * 4 + 100 * 50 * 4);
    }
    EXPECT_EQ(gl::Context::current().tally().bytes, before);
}

TEST(Framebuffers, AreMadeOnceForTheSameTextures) {
    testContext();
    const gl::Texture colour(gl::Format::R32F, {8, 8}), depth(gl::Format::Depth32F, {8, 8});
    const gl::Attachments both{{colour.id(), depth.id()}}, swapped{{depth.id(), colour.id()}};
    gl::Framebuffers framebuffers;
    unsigned made = 0;
    const auto make = [&] { return 1000 + made++; };
    const unsigned first = framebuffers.over(both, make);
    EXPECT_EQ(framebuffers.over(both, make), first);
    EXPECT_NE(framebuffers.over(swapped, make), first);
    EXPECT_NE(framebuffers.over({{colour.id(), depth.id()}, 1}, make), first); // another layer
    EXPECT_EQ(made, 3U);
    framebuffers.forget(depth.id());
    framebuffers.over(both, make);
    EXPECT_EQ(made, 4U);
}

/// The framebuffer that draws go to.
unsigned boundFramebuffer() {
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    return static_cast<unsigned>(bound);
}

TEST(Framebuffers, AreSharedByTheTargetsOfATextureAndEndWithIt) {
    testContext();
    unsigned framebuffer = 0;
    {
        const gl::Texture texture(gl::Format::R32F, {4, 4}), other(gl::Format::R32F, {4, 4});
        gl::RenderTarget({&texture}).bind();
        framebuffer = boundFramebuffer();
        gl::RenderTarget({&other}).bind();
        EXPECT_NE(boundFramebuffer(), framebuffer);
        gl::RenderTarget({&texture}).bind();
        EXPECT_EQ(boundFramebuffer(), framebuffer);
        EXPECT_TRUE(glIsFramebuffer(framebuffer));
    }
    EXPECT_FALSE(glIsFramebuffer(framebuffer)); // GL may give the texture's name to another one
}

TEST(WorkMeter, CountsTheFragmentsAndDrawsOfAFullScreenPass) {
    testContext();
    const gl::Texture target(gl::Format::R32F, {96, 64});
    const gl::Texture sum(gl::Format::R32F, {96, 64});
    gl::Program program = gl::Program::screen("shared/sampling/mean.frag");
    program.set("sum", sum).set("count", 1.0F);
    gl::WorkMeter meter;
    const gl::RenderTarget pass({&target});
    pass.bind();
    program.drawScreen();
    const gl::WorkCount count = meter.finish();
    // llvmpipe counts whole 4×4 blocks along the triangle's diagonal.
    EXPECT_GE(count.fragments, 96U * 64);
    EXPECT_LE(count.fragments, 96U * 64 * 11 / 10);
    EXPECT_EQ(count.vertices, 3U);
    EXPECT_EQ(count.primitives, 1U);
    EXPECT_EQ(count.draws, 1U);
    EXPECT_EQ(count.passes, 1U);
}

TEST(WorkMeter, CountsEveryInstancesPrimitives) {
    Scene scene = boxScene();
    for (int i = 1; i < 5; ++i) scene.objects[1].instances.push_back(object(Mesh{}, {0.1 * i, 2, 0}).instances[0]);
    Stage stage(scene);
    stage.show(0);
    gl::WorkMeter meter;
    stage.redraw();
    EXPECT_EQ(meter.finish().primitives, 12U + 5 * 12);
}

TEST(GBuffer, EveryPositionProjectsToItsPixelCentre) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    std::size_t hits = 0;
    for (int y = 0; y < scene.size.y; ++y)
        for (int x = 0; x < scene.size.x; ++x) {
            if (drawn.id(x, y) == 0) continue;
            ++hits;
            const glm::dvec3 p = scene.camera.project(drawn.position(x, y), scene.size);
            // Vertices are snapped to 1/256 px by the rasteriser, and positions are 32-bit floats.
            EXPECT_NEAR(p.x, x + 0.5, 0.01);
            EXPECT_NEAR(p.y, y + 0.5, 0.01);
        }
    EXPECT_GT(hits, 6000U); // the slab fills half of the picture
}

TEST(GBuffer, RowZeroIsTheTopOfThePicture) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const int x = scene.size.x / 2;
    EXPECT_LT(drawn.position(x, scene.size.y / 4).z, drawn.position(x, scene.size.y - 5).z); // far above, near below
}

TEST(GBuffer, IdsAreThePlacements) {
    const Scene scene = boxScene();
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        ASSERT_LE(drawn.id[i], 2U);
        if (drawn.id[i] == 0) continue;
        const bool onBox = drawn.position[i].y > 0.5F;
        EXPECT_EQ(drawn.id[i], onBox ? 2U : 1U);
    }
}

TEST(GBuffer, NormalsOfAGroundThatReachesItsHorizonPointToTheViewer) {
    Scene scene = boxScene();
    scene.objects = {object(plane(9000), {0, 0, 0})};
    for (int tilt = 0; tilt < 16; ++tilt) { // the horizon between two rows of pixels, and within a row
        scene.camera = {{0, 1.7, 0}, {0, 1.6 - 0.004 * tilt, -10}, {0, 1, 0}, 50, 0.1, 20000};
        const Snapshot shown = snapshot(scene, 0);
        gl::SceneBuffers buffers;
        buffers.update(shown);
        gl::GBuffer gbuffer(scene.size);
        gbuffer.draw(buffers, shown.camera.projection(1) * shown.camera.view());
        const auto ids = gbuffer.readIds();
        const auto normals = gbuffer.readNormals();
        for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_TRUE(ids[i] == 0 || normals[i].y > 0.9F) << tilt << " " << i;
    }
}

TEST(GBuffer, KnowsWhereVerticesThatDeformWereBefore) {
    const Scene scene = boxScene();
    Snapshot shown = snapshot(scene, 0);
    const auto stretched = std::make_shared<Mesh>(*shown.batches[1].mesh);
    for (glm::vec3& position : stretched->positions) position *= glm::vec3(2, 1, 0.5F);
    shown.batches[1].previousMesh = stretched;
    gl::SceneBuffers buffers;
    buffers.update(shown);
    EXPECT_TRUE(buffers.moving());
    gl::GBuffer gbuffer(scene.size);
    gbuffer.draw(buffers, shown.camera.projection(1) * shown.camera.view());
    const auto now = gbuffer.readPositions(), before = gl::RenderTarget({&gbuffer.previousPosition()}).readVec4(0);
    const auto ids = gbuffer.readIds();
    const glm::dmat4& world = shown.batches[1].placements[0].world;
    int pixels = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == 0) continue;
        glm::dvec4 expected(now[i]);
        if (ids[i] == 2) expected = world * (glm::inverse(world) * expected * glm::dvec4(2, 1, 0.5, 1));
        EXPECT_LT(glm::distance(glm::dvec4(before[i]), expected), 1e-4);
        pixels += ids[i] == 2 ? 1 : 0;
    }
    EXPECT_GT(pixels, 200);
    shown.batches[1].previousMesh.reset();
    buffers.update(shown);
    EXPECT_FALSE(buffers.moving());
}

TEST(GBuffer, OverscanLeavesTheInnerPixelsWhereTheyAre) {
    const Scene scene = boxScene();
    const Snapshot shown = snapshot(scene, 0);
    gl::SceneBuffers buffers;
    buffers.update(shown);
    const glm::dmat4 clip = shown.camera.projection(1) * shown.camera.view();
    constexpr glm::ivec2 border(5, 3);
    gl::GBuffer plain(scene.size), wide(scene.size, border);
    plain.draw(buffers, clip);
    wide.draw(buffers, clip);
    EXPECT_EQ(wide.size(), scene.size + 2 * border);
    const auto a = plain.readPositions(), b = wide.readPositions();
    const auto ids = plain.readIds();
    const auto wideIds = wide.readIds();
    int moved = 0;
    for (int y = 0; y < scene.size.y; ++y)
        for (int x = 0; x < scene.size.x; ++x) {
            const glm::ivec2 at = glm::ivec2(x, y) + border;
            const bool same = ids(x, y) == wideIds(at.x, at.y) && glm::distance(a(x, y), b(at.x, at.y)) <= 1e-3F;
            moved += same ? 0 : 1;
        }
    EXPECT_LE(moved, 4); // edges within 1/256 px of a pixel centre may fall to the other side
}

} // namespace
} // namespace shadowbench
