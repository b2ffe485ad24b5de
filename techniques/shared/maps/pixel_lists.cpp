#include "techniques/shared/maps/pixel_lists.h"

#include "techniques/gl/read_buffer.h"
#include "techniques/shared/maps/depth_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t), corner = sizeof(glm::vec4);
constexpr unsigned testsBinding = 7;     // shared/maps/cast_triangles.glsl
constexpr std::size_t groupsOfLater = 1; // a word of shared/maps/large_triangles.glsl
constexpr int tileSide = 8;              // shared/maps/large_triangles.glsl
constexpr int mostRounds = 65000;        // llvmpipe ends a shader's loops after 65,535 rounds in all

std::size_t pixelsOf(const Frame& frame) {
    return static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y);
}

std::size_t triangles(const gl::SceneBuffers::Batch& batch) {
    return static_cast<std::size_t>(batch.triangles) * static_cast<std::size_t>(batch.instances);
}

gl::Defines with(gl::Defines defines, const std::string& name, int value = 1) {
    defines.emplace_back(name, std::to_string(value));
    return defines;
}

std::size_t trianglesOf(const Frame& frame) {
    std::size_t count = 0;
    for (const gl::SceneBuffers::Batch& batch : frame.scene.batches()) count += triangles(batch);
    return count;
}

/// How far the light reaches from its middle in its own view, times depth.
glm::vec2 reach(const LightView& view, const std::vector<glm::dvec4>& lights) {
    const glm::dmat4 map = mapFromClip() * view.clipFromWorld;
    const glm::dvec4 middle =
        std::accumulate(lights.begin(), lights.end(), glm::dvec4(0)) / static_cast<double>(lights.size());
    glm::dvec2 farthest(0);
    for (const glm::dvec4& light : lights) farthest = glm::max(farthest, glm::abs(glm::dvec2(map * (light - middle))));
    return farthest;
}

/// The greatest distance of the scene from the light's plane.
double deepest(const LightView& view, const Snapshot& snapshot) {
    double depth = 0;
    for (const glm::dvec3& p : snapshot.bounds().corners())
        depth = std::max(depth, std::abs(glm::dot(view.depthFromWorld, glm::dvec4(p, 1))));
    return depth;
}

} // namespace

PixelLists::Casts::Casts(const std::string& shade, const gl::Defines& defines)
    : small(gl::Program::compute(shade, defines)), large(gl::Program::compute(shade, with(defines, "LARGE"))) {}

PixelLists::PixelLists(std::string shade, gl::Defines defines, int grid, int words, int lights, int roundsOfLarge)
    : shade_(std::move(shade)), defines_(with(with(std::move(defines), "ROUNDS", mostRounds), "LIGHTS", lights)),
      grid_(grid), words_(static_cast<std::size_t>(words)),
      largeAtOnce_(static_cast<std::size_t>(mostRounds / roundsOfLarge)),
      bin_(gl::Program::compute("shared/maps/bin_pixels.comp")), casts_(shade_, defines_) {}

void PixelLists::gather(const Frame& frame, const LightView& view, std::vector<glm::dvec4> lights) {
    const auto pass = frame.pass("pixel lists");
    view_ = view;
    lights_ = std::move(lights);
    const std::size_t pixels = pixelsOf(frame);
    heads_.clear(2 * static_cast<std::size_t>(grid_) * static_cast<std::size_t>(grid_) * word);
    nexts_.clear(pixels * word);
    results_.clear(pixels * words_ * word);
    clearLarge(frame);
    bind();
    setGrid(bin_);
    bin_.set("positions", frame.gbuffer.position());
    bin_.dispatch(pixels);
}

void PixelLists::bind() const {
    unsigned binding = 3; // shared/maps/pixel_lists.glsl, large_triangles.glsl
    for (const gl::Buffer* buffer : {&heads_, &nexts_, &results_, &large_}) buffer->bindStorage(binding++);
}

void PixelLists::setGrid(gl::Program& program) const {
    program.set("mapFromWorld", mapFromWorld(view_))
        .set("grid", grid_)
        .set("nearest", static_cast<float>(view_.perspective ? 1e-4 * view_.far : 0));
}

void PixelLists::clearLarge(const Frame& frame) { large_.clear(4 * word + 3 * trianglesOf(frame) * corner); }

void PixelLists::cast(const Frame& frame, const std::function<void(gl::Program&)>& set) {
    const auto pass = frame.pass("triangle tests");
    castAll(frame, casts_, set);
}

void PixelLists::castAll(const Frame& frame, Casts& casts, const std::function<void(gl::Program&)>& set) {
    for (gl::Program* program : {&casts.small, &casts.large}) {
        program->set("positions", frame.gbuffer.position()).set("mostLarge", static_cast<int>(largeAtOnce_));
        set(*program);
    }
    setGrid(casts.small);
    casts.small.set("headTexels", headTexels_)
        .set("nextTexels", nextTexels_)
        .set("reach", reach(view_, lights_))
        .set("deepest", static_cast<float>(deepest(view_, frame.snapshot)));
    frame.scene.instances().bindStorage(2);
    for (const gl::SceneBuffers::Batch& batch : frame.scene.batches()) {
        batch.vertices.bindStorage(0);
        batch.indices.bindStorage(1);
        casts.small.set("triangleCount", batch.triangles)
            .set("instanceCount", batch.instances)
            .set("baseInstance", static_cast<int>(batch.baseInstance));
        casts.small.dispatch(triangles(batch));
    }
    const std::vector<glm::vec4> lights(lights_.begin(), lights_.end());
    casts.large.set("largeTriangles", largeTriangles_).set("lights", lights);
    const glm::ivec2 tiles = (frame.size + tileSide - 1) / tileSide;
    for (std::size_t first = 0; first < trianglesOf(frame); first += largeAtOnce_) {
        casts.large.set("firstLarge", static_cast<int>(first));
        if (first == 0)
            casts.large.dispatchGroups({tiles, 1});
        else
            casts.large.dispatchGroups(large_, groupsOfLater);
    }
}

std::uint64_t PixelLists::tests(const Frame& frame, const std::function<void(gl::Program&)>& set) {
    Casts counting(shade_, with(defines_, "COUNT_TESTS"));
    clearLarge(frame);
    bind();
    gl::Buffer tests;
    tests.clear(word);
    tests.bindStorage(testsBinding);
    castAll(frame, counting, set);
    return gl::readWords(tests, 1).front();
}

} // namespace shadowbench::techniques
