#include "techniques/shared/maps/pixel_lists.h"

#include "techniques/gl/read_buffer.h"
#include "techniques/shared/maps/depth_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t), corner = sizeof(glm::vec4);
constexpr unsigned testsBinding = 7; // shared/maps/cast_triangles.glsl
constexpr int mostRounds = 65000;    // llvmpipe ends a shader's loops after 65,535 rounds in all

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

/// How far half of `side` reaches in the light's view, times depth.
glm::dvec2 halfReach(const glm::dmat4& mapFromWorld, const glm::dvec3& side) {
    return 0.5 * glm::abs(glm::dvec2(mapFromWorld * glm::dvec4(side, 0)));
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

PixelLists::PixelLists(std::string shade, gl::Defines defines, int grid, int words, int roundsOfLarge)
    : shade_(std::move(shade)), defines_(with(std::move(defines), "ROUNDS", mostRounds)), grid_(grid),
      words_(static_cast<std::size_t>(words)), largeAtOnce_(static_cast<std::size_t>(mostRounds / roundsOfLarge)),
      bin_(gl::Program::compute("shared/maps/bin_pixels.comp")), casts_(shade_, defines_) {}

void PixelLists::gather(const Frame& frame, const LightView& view, const glm::dvec3& u, const glm::dvec3& v) {
    const auto pass = frame.pass("pixel lists");
    view_ = view;
    const glm::dmat4 map = mapFromClip() * view.clipFromWorld;
    reach_ = glm::vec2(halfReach(map, u) + halfReach(map, v));
    const std::size_t pixels = pixelsOf(frame);
    heads_.clear(2 * static_cast<std::size_t>(grid_) * static_cast<std::size_t>(grid_) * word);
    nexts_.clear(pixels * word);
    results_.clear(pixels * words_ * word);
    clearLarge(frame);
    bind();
    setGrid(bin_);
    bin_.set("positions", frame.gbuffer.position()).set("pixels", static_cast<int>(pixels));
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
        program->set("positions", frame.gbuffer.position());
        set(*program);
    }
    setGrid(casts.small);
    casts.small.set("reach", reach_).set("deepest", static_cast<float>(deepest(view_, frame.snapshot)));
    frame.scene.instances().bindStorage(2);
    for (const gl::SceneBuffers::Batch& batch : frame.scene.batches()) {
        batch.vertices.bindStorage(0);
        batch.indices.bindStorage(1);
        casts.small.set("triangleCount", batch.triangles)
            .set("instanceCount", batch.instances)
            .set("baseInstance", static_cast<int>(batch.baseInstance));
        casts.small.dispatch(triangles(batch));
    }
    const std::size_t pixels = pixelsOf(frame);
    casts.large.set("largeTriangles", largeTriangles_)
        .set("pixels", static_cast<int>(pixels))
        .set("mostLarge", static_cast<int>(largeAtOnce_));
    for (std::size_t first = 0; first < trianglesOf(frame); first += largeAtOnce_) {
        casts.large.set("firstLarge", static_cast<int>(first));
        casts.large.dispatch(pixels);
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
