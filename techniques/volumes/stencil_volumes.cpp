#include "techniques/volumes/stencil_volumes.h"

#include "techniques/gl/api.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <limits>

namespace shadowbench::techniques {
namespace {

// The stencil holds 8 bits: 256 volumes around a point would count as none. At most this many placements are counted
// together; a point within 256 layers of their volumes, which takes placements that shade it more than once, still counts as
// lit.
constexpr std::size_t countedTogether = 255;

void setStencilOperations(VolumeTest test) {
    glStencilMask(test == VolumeTest::ExclusiveOr ? 0x01 : 0xFF);
    glStencilFunc(GL_ALWAYS, 0, 0xFF);
    switch (test) {
    case VolumeTest::PerCaster: // each volume has one of the others
    case VolumeTest::DepthFail:
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
        return;
    case VolumeTest::DepthPass:
    case VolumeTest::NearPlane:
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
        return;
    case VolumeTest::ExclusiveOr:
        glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
        return;
    }
}

Caps capsFor(VolumeTest test, bool meetsNearPlane) {
    if (test == VolumeTest::DepthFail) return Caps::Both;
    return test == VolumeTest::NearPlane && meetsNearPlane ? Caps::Front : Caps::None;
}

} // namespace

std::vector<Figure> volumeFigures() {
    return {{"volume_triangles", "triangles of all shadow volumes that are drawn"},
            {"volume_fragments", "pixels that these triangles cover, counted as often as they are covered"},
            {"volumes_culled", "casters without a volume, since no pixel's ray can meet it"},
            {"volumes_by_depth_fail", "casters whose volumes are closed by caps and counted by depth-fail"},
            {"stencil_updates", "times that a stencil value changes"},
            {"stencil_bytes", "bytes that counting reads and writes: depth and stencil of a pixel are one word of 4 bytes, "
                              "read for every fragment and written for every update"}};
}

glm::dmat4 clipFromWorld(const Frame& frame, FarPlane far) {
    if (far == FarPlane::OfCamera) return frame.clipFromWorld;
    const Camera& camera = frame.snapshot.camera;
    return infiniteProjection(camera.projection(frame.aspect()), camera.near) * camera.view();
}

StencilVolumes::VolumeMesh::VolumeMesh(std::shared_ptr<const Mesh> mesh) : source(std::move(mesh)), edges(*source) {
    std::vector<glm::vec4> doubled;
    for (const float w : {1.0F, 0.0F})
        for (const glm::vec3& p : source->positions) doubled.emplace_back(p, w);
    vertices.upload(doubled.data(), doubled.size() * sizeof(glm::vec4));
}

StencilVolumes::StencilVolumes(VolumeTest test, FarPlane far)
    : test_(test), far_(far), volume_("volumes/volume.vert", "gl/depth_only.frag"),
      shadowed_(gl::Program::screen("volumes/shadowed.frag")) {
    if (test == VolumeTest::NearPlane) nearPlane_.emplace("volumes/near_plane.vert", "gl/depth_only.frag");
}

void StencilVolumes::render(const Frame& frame, const glm::dvec4& light, const gl::Texture& depthStencil,
                            const gl::Texture& visibility) {
    buildVolumes(frame, light);
    volume_.set("clipFromWorld", glm::mat4(clipFromWorld(frame, far_))).set("light", glm::vec4(light));
    if (nearPlane_) setNearPlane(clipFromWorld(frame, far_), light);

    const gl::RenderTarget target({&visibility, &depthStencil});
    target.clearColour(0, glm::vec4(1));
    // A parity has no range that it could leave.
    const std::size_t group = test_ == VolumeTest::ExclusiveOr ? draws_.size() : countedTogether;
    for (std::size_t first = 0; first < draws_.size(); first += group) {
        target.clearStencil();
        target.bind();
        count(frame, Draws(draws_).subspan(first, std::min(group, draws_.size() - first)));
        darken(frame, target);
    }
}

const StencilVolumes::VolumeMesh& StencilVolumes::volumeMesh(const std::shared_ptr<const Mesh>& mesh,
                                                             const gl::SceneBuffers& scene) {
    auto& entry = meshes_[mesh.get()];
    if (entry) return *entry;
    entry = std::make_unique<VolumeMesh>(mesh);
    entry->layout.bind();
    glBindBuffer(GL_ARRAY_BUFFER, entry->vertices.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(glm::vec4), nullptr);
    scene.bindInstances();
    return *entry;
}

/// The light's view through the near plane's window is an image of the same pixels: each point is projected from the light
/// onto the plane, and from there into the image.
void StencilVolumes::setNearPlane(const glm::dmat4& clipFromWorld, const glm::dvec4& light) {
    const glm::dmat4 rows = glm::transpose(clipFromWorld);
    const glm::dvec4 plane = rows[3] + rows[2]; // dot(plane, p) ≥ 0 beyond it
    const double side = glm::dot(plane, light) < 0 ? -1 : 1;
    const glm::dmat4 projection = glm::dot(plane, light) * glm::dmat4(1) - glm::outerProduct(light, plane);
    nearPlane_->set("clipFromWorld", glm::mat4(side * clipFromWorld * projection)).set("lightSide", glm::vec4(side * plane));
}

/// How a caster's volume is counted; nothing where no pixel's ray meets it, for then it changes no count. Depth-pass lacks
/// what a ray crosses between eye and near plane, the caps above all, which it does not draw. An open mesh's volume is open
/// at infinity, too, and depth-fail counts it beyond the far plane, where depth is clamped: the paper asks for closed models
/// (its section 3.1), and how it fails on others is left as it is.
std::optional<VolumeTest> StencilVolumes::testFor(const EdgeMesh& mesh, const VolumeBounds& volume, const View& view) const {
    const bool bySides = test_ != VolumeTest::DepthFail && test_ != VolumeTest::PerCaster;
    if (!mesh.mesh().closed && !bySides) return VolumeTest::DepthFail;
    if (!volume.mayMeet(view.seen)) return std::nullopt;
    if (test_ != VolumeTest::PerCaster) return test_;
    return volume.mayMeet(view.beforeNear) ? VolumeTest::DepthFail : VolumeTest::DepthPass;
}

/// The volumes of all placements, each with its own light position in object space.
void StencilVolumes::buildVolumes(const Frame& frame, const glm::dvec4& light) {
    const auto pass = frame.pass("silhouette volumes");
    const Camera& camera = frame.snapshot.camera;
    const double far = far_ == FarPlane::AtInfinity ? std::numeric_limits<double>::infinity() : camera.far;
    const View view{{camera, frame.aspect(), far}, {camera, frame.aspect(), camera.near}};
    draws_.clear();
    corners_.clear();
    std::size_t placements = 0;
    for (const Batch& batch : frame.snapshot.batches) {
        const VolumeMesh& mesh = volumeMesh(batch.mesh, frame.scene);
        for (const Placement& placement : batch.placements) {
            const VolumeBounds volume(mesh.edges.bounds(), placement.world, {&light, 1});
            if (const auto test = testFor(mesh.edges, volume, view))
                appendVolume(mesh, placements, *test, capsFor(*test, volume.mayMeet(view.beforeNear)),
                             glm::inverse(placement.world) * light);
            ++placements;
        }
    }
    culled_ = placements - draws_.size();
    std::ranges::stable_partition(draws_, [](const Draw& draw) { return draw.test != VolumeTest::DepthFail; });
    indices_.upload(corners_.data(), corners_.size() * sizeof(std::uint32_t));
}

void StencilVolumes::appendVolume(const VolumeMesh& mesh, std::size_t placement, VolumeTest test, Caps caps,
                                  const glm::dvec4& objectLight) {
    const std::size_t first = corners_.size();
    const std::size_t capCorners = appendShadowVolume(mesh.edges, objectLight, caps, corners_);
    draws_.push_back({&mesh, placement, test, first, capCorners, corners_.size() - first - capCorners});
}

/// Those counted from the eye, and those counted by depth-fail.
std::array<StencilVolumes::Draws, 2> StencilVolumes::byTest(Draws draws) {
    const auto second = std::ranges::find(draws, VolumeTest::DepthFail, &Draw::test);
    return {Draws(draws.begin(), second), Draws(second, draws.end())};
}

void StencilVolumes::count(const Frame& frame, Draws draws) const {
    const auto pass = frame.pass("stencil count");
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawCounting(draws);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/// Each by its own test.
void StencilVolumes::drawCounting(Draws draws) const {
    glEnable(GL_STENCIL_TEST);
    if (nearPlane_) drawNearPlane(draws);
    glDepthFunc(GL_LESS);
    for (const Draws& part : byTest(draws)) {
        if (part.empty()) continue;
        setStencilOperations(part.front().test);
        drawVolumes(part);
    }
    glDisable(GL_STENCIL_TEST);
}

/// Adds to each pixel's count the facing triangles that lie between the light and its point of the near plane.
void StencilVolumes::drawNearPlane(Draws draws) const {
    glStencilMask(0xFF);
    glStencilFunc(GL_ALWAYS, 0, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR_WRAP);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP); // all depths are the near plane's own
    glEnable(GL_CLIP_DISTANCE0);
    nearPlane_->use();
    for (const Draw& draw : draws) {
        if (draw.caps == 0) continue;
        draw.mesh->layout.bind();
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
        drawCorners(draw, draw.first, draw.caps);
    }
    glDisable(GL_CLIP_DISTANCE0);
    glDisable(GL_DEPTH_CLAMP);
}

/// Depth is tested and not written. It is clamped, but where the near plane is where counts begin.
void StencilVolumes::drawVolumes(Draws draws) const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    if (!nearPlane_) glEnable(GL_DEPTH_CLAMP);
    glDisable(GL_CULL_FACE);
    volume_.use();
    for (const Draw& draw : draws) {
        draw.mesh->layout.bind();
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
        if (!nearPlane_) drawCaps(draw);
        drawCorners(draw, draw.first + draw.caps, draw.sides);
    }
    glDisable(GL_DEPTH_CLAMP);
    glDepthMask(GL_TRUE);
}

std::uint64_t StencilVolumes::fragmentsPassing(unsigned depthFunction, Draws draws, const gl::Texture& depthStencil) const {
    const gl::RenderTarget depthOnly({&depthStencil});
    depthOnly.bind();
    glDepthFunc(depthFunction);
    gl::FragmentMeter meter;
    drawVolumes(draws);
    glDepthFunc(GL_LESS);
    return meter.finish();
}

std::uint64_t StencilVolumes::fragmentsOnNearPlane(Draws draws, const gl::Texture& depthStencil) const {
    const gl::RenderTarget depthOnly({&depthStencil});
    depthOnly.bind();
    gl::FragmentMeter meter;
    drawNearPlane(draws);
    return meter.finish();
}

std::map<std::string, double> StencilVolumes::figures(const gl::Texture& depthStencil) const {
    std::uint64_t fragments = nearPlane_ ? fragmentsOnNearPlane(draws_, depthStencil) : 0, updates = fragments;
    for (const Draws& part : byTest(draws_)) {
        const std::uint64_t all = fragmentsPassing(GL_ALWAYS, part, depthStencil);
        const std::uint64_t passing = fragmentsPassing(GL_LESS, part, depthStencil);
        const bool byDepthFail = !part.empty() && part.front().test == VolumeTest::DepthFail;
        fragments += all;
        updates += byDepthFail ? all - passing : passing;
    }
    return {{"volume_triangles", static_cast<double>(corners_.size()) / 3},
            {"volume_fragments", static_cast<double>(fragments)},
            {"volumes_culled", static_cast<double>(culled_)},
            {"volumes_by_depth_fail", static_cast<double>(byTest(draws_).back().size())},
            {"stencil_updates", static_cast<double>(updates)},
            {"stencil_bytes", 4.0 * static_cast<double>(fragments + updates)}};
}

/// A front cap lies on a surface of the scene and must count as behind it. No equality of depths assures that: the surface
/// was clipped at the camera's far plane, where the cap is clamped, and their depths round differently. So caps are pushed
/// away: nothing that is seen lies behind a cap, but where the near plane cuts the cap off, and there depth is far from it.
void StencilVolumes::drawCaps(const Draw& draw) const {
    constexpr float units = 1024; // 2⁻¹⁴ of the depth range: far above the rounding
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0, units);
    drawCorners(draw, draw.first, draw.caps);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void StencilVolumes::drawCorners(const Draw& draw, std::size_t first, std::size_t count) const {
    if (count == 0) return;
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                                        reinterpret_cast<const void*>(first * sizeof(std::uint32_t)), 1,
                                        static_cast<GLuint>(draw.placement));
    ++gl::Context::current().tally().draws;
}

void StencilVolumes::darken(const Frame& frame, const gl::RenderTarget& target) const {
    const auto pass = frame.pass("resolve");
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NOTEQUAL, 0, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    target.bind();
    shadowed_.drawScreen();
    glDisable(GL_STENCIL_TEST);
}

} // namespace shadowbench::techniques
