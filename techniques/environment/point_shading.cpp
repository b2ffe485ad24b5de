#include "techniques/environment/point_shading.h"

#include "techniques/gl/api.h"

#include <algorithm>
#include <glm/vec3.hpp>

namespace shadowbench::techniques {
namespace {

/// A patch as environment/lookup.frag reads it.
struct GpuPatch {
    glm::vec3 origin;
    std::uint32_t firstRow;
    glm::vec3 along;
    std::uint32_t steps;
    glm::vec3 up;
    float padding = 0;
};

template <typename T>
void uploadAll(gl::Buffer& buffer, const std::vector<T>& values) {
    buffer.upload(values.data(), values.size() * sizeof(T));
}

bool sameSurfaces(const Batch& a, const Batch& b) {
    return a.mesh == b.mesh && std::ranges::equal(a.placements, b.placements, [](const Placement& p, const Placement& q) {
               return p.id == q.id && p.world == q.world;
           });
}

} // namespace

void PointShading::begin(const Snapshot& snapshot, std::size_t budget) {
    batches_ = snapshot.batches;
    points_ = spreadPoints(snapshot, budget);
    uploadPoints();
}

bool PointShading::isOf(const Snapshot& snapshot) const {
    return std::ranges::equal(batches_, snapshot.batches, sameSurfaces);
}

void PointShading::uploadPoints() {
    std::vector<GpuPatch> patches;
    for (const PointPatch& patch : points_.patches)
        patches.push_back(
            {glm::vec3(patch.origin), patch.firstRow, glm::vec3(patch.along), patch.steps, glm::vec3(patch.up)});
    uploadAll(surfaces_, points_.surfaces);
    uploadAll(patches_, patches);
    uploadAll(rows_, points_.rows);
    irradiance_.clear(pointCount() * sizeof(float));
    unshadowed_.clear(patchCount() * sizeof(float));
}

void PointShading::setDotProducts(const gl::Buffer& results, std::size_t count, const gl::Buffer& transfer,
                                  const gl::Buffer& light, std::size_t coefficients) {
    transfer.bindStorage(0);
    light.bindStorage(1);
    results.bindStorage(2);
    dotProducts_.set("vectors", static_cast<int>(count)).set("coefficients", static_cast<int>(coefficients));
    dotProducts_.dispatch(count);
}

void PointShading::lookUp(const Frame& frame, const gl::Texture& visibility) {
    const auto pass = frame.pass("lookup");
    unsigned binding = 0;
    for (const gl::Buffer* buffer : {&surfaces_, &patches_, &rows_, &irradiance_, &unshadowed_})
        buffer->bindStorage(binding++);
    const gl::RenderTarget target({&visibility, &frame.gbuffer.depthStencil()});
    target.clearColour(0, glm::vec4(1));
    target.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_EQUAL); // positions are invariant: the surface that the G-buffer holds, and no other
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    lookUp_.set("clipFromWorld", glm::mat4(frame.gbuffer.widened(frame.clipFromWorld))).use();
    frame.scene.draw();
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

} // namespace shadowbench::techniques
