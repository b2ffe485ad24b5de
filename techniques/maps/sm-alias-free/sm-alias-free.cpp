// Alias-free shadow maps (Aila, Laine 2004; Johnson, Mark, Burns 2004): the irregular z-buffer. Pixels are projected into
// the light's view and kept in lists, one a grid cell; every triangle is then tested exactly against the pixels of all cells
// that it touches. Scherzer 2.2.2, "Irregular Sampling"; the lists and the order of work are those of Sintorn, Eisemann,
// Assarsson 2008 (2.3.5), in compute shaders. Departures: the lists are linked; a triangle visits the cells of its
// projection's bounding box, not of a conservative rasterisation, and the test is made in world space relative to the
// pixel's point.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/single_map.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowbench::techniques {
namespace {

std::size_t triangles(const std::vector<gl::SceneBuffers::Batch>& batches) {
    std::size_t count = 0;
    for (const auto& batch : batches)
        count += static_cast<std::size_t>(batch.triangles) * static_cast<std::size_t>(batch.instances);
    return count;
}

class AliasFree final : public Technique {
public:
    explicit AliasFree(const Parameters& p)
        : grid_(p.integer("grid")), slack_(p.real("slack")), bin_(gl::Program::compute("maps/sm-alias-free/bin.comp")),
          cast_(gl::Program::compute("maps/sm-alias-free/cast.comp")),
          castLarge_(gl::Program::compute("maps/sm-alias-free/cast_large.comp")),
          resolve_(gl::Program::screen("maps/sm-alias-free/sm-alias-free.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const auto pixels = static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y);
        binPixels(frame, pixels);
        castAll(frame, pixels);
        resolve_.set("width", frame.size.x);
        resolve(frame, {&visibility}, resolve_);
    }

private:
    /// Puts the pixels into the lists of their cells.
    void binPixels(const Frame& frame, std::size_t pixels) {
        const auto pass = frame.pass("pixel lists");
        clear(pixels, triangles(frame.scene.batches()));
        const LightView view = focusedView(frame);
        for (gl::Program* program : {&bin_, &cast_})
            program->set("mapFromWorld", mapFromWorld(view))
                .set("grid", grid_)
                .set("nearest", static_cast<float>(view.perspective ? 1e-4 * view.far : 0));
        bin_.set("positions", frame.gbuffer.position()).set("pixels", static_cast<int>(pixels));
        bin_.dispatch(pixels);
    }

    void clear(std::size_t pixels, std::size_t triangles) {
        constexpr std::size_t word = sizeof(std::uint32_t), corner = sizeof(glm::vec4);
        heads_.clear(2 * static_cast<std::size_t>(grid_) * static_cast<std::size_t>(grid_) * word);
        nexts_.clear(pixels * word);
        shadows_.clear(pixels * word);
        large_.clear(4 * word + 3 * triangles * corner);
        unsigned binding = 3; // samples.glsl, large.glsl
        for (const gl::Buffer* buffer : {&heads_, &nexts_, &shadows_, &large_}) buffer->bindStorage(binding++);
    }

    void castAll(const Frame& frame, std::size_t pixels) {
        const auto pass = frame.pass("triangle tests");
        const Bounds bounds = frame.snapshot.bounds();
        for (gl::Program* program : {&cast_, &castLarge_})
            program->set("light", glm::vec4(frame.hardLight.homogeneous()))
                .set("slack", static_cast<float>(slack_ * glm::distance(bounds.low, bounds.high)))
                .set("positions", frame.gbuffer.position());
        frame.scene.instances().bindStorage(2);
        for (const gl::SceneBuffers::Batch& batch : frame.scene.batches()) {
            batch.vertices.bindStorage(0);
            batch.indices.bindStorage(1);
            cast_.set("triangleCount", batch.triangles)
                .set("instanceCount", batch.instances)
                .set("baseInstance", static_cast<int>(batch.baseInstance));
            cast_.dispatch(triangles({batch}));
        }
        castLarge_.set("pixels", static_cast<int>(pixels));
        castLarge_.dispatch(pixels);
    }

    int grid_;
    double slack_;
    gl::Program bin_, cast_, castLarge_, resolve_;
    gl::Buffer heads_, nexts_, shadows_, large_;
};

} // namespace

Entry smAliasFree() {
    return {.id = "sm-alias-free",
            .title = "Alias-free shadow map (irregular z-buffer)",
            .source = {Document::Dissertation, "2.2.2, Irregular Sampling; 2.3.5"},
            .answer = Answer::Hard,
            .parameters = {{"grid", "256", IntegerRange{1, 2048}, "cells per side of the grid over the light's view", ""},
                           {"slack", "1e-5", RealRange{0, 1},
                            "of the scene's diagonal: a receiver closer than this to a triangle's plane lies on it", ""}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<AliasFree>(p); }};
}

} // namespace shadowbench::techniques
