// Stencil shadow volumes, depth-fail (Everitt–Kilgard, course "Practical and robust stenciled shadow volumes";
// Zápotocký 2.4.4). Back faces that fail the depth test increment, front faces decrement, both in one pass with wrapping
// two-sided stencil; a pixel whose count ends at zero is lit. Vertices at infinity are homogeneous; `far=clamp` keeps the
// camera's far plane and clamps depth (the paper's section 3.4), `far=infinity` draws depth again under P_inf.
#include "techniques/entries.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/resolve.h"
#include "techniques/volumes/shadow_volume.h"

#include <memory>
#include <optional>
#include <unordered_map>

namespace shadowbench::techniques {
namespace {

/// A mesh's vertices twice, at w = 1 and at w = 0, and its edges.
struct VolumeMesh {
    explicit VolumeMesh(std::shared_ptr<const Mesh> mesh) : source(std::move(mesh)), edges(*source) {
        std::vector<glm::vec4> doubled;
        for (const float w : {1.0F, 0.0F})
            for (const glm::vec3& p : source->positions) doubled.emplace_back(p, w);
        vertices.upload(doubled.data(), doubled.size() * sizeof(glm::vec4));
    }
    std::shared_ptr<const Mesh> source;
    EdgeMesh edges;
    gl::Buffer vertices;
    gl::VertexArray layout;
};

class VolumeZfail final : public Technique {
public:
    explicit VolumeZfail(const Parameters& p)
        : infinite_(p.text("far") == "infinity"), depth_("volumes/volume-zfail/depth.vert", "maps/depth_map.frag"),
          volume_("volumes/volume-zfail/volume.vert", "maps/depth_map.frag"),
          resolve_(gl::Program::screen("volumes/volume-zfail/volume-zfail.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const gl::Texture* depthStencil = &frame.gbuffer.depthStencil();
        glm::mat4 clipFromWorld(frame.clipFromWorld);
        if (infinite_) {
            clipFromWorld = glm::mat4(infiniteClip(frame));
            depthStencil = &drawDepth(frame, clipFromWorld);
        }
        const gl::RenderTarget target({&visibility, depthStencil});
        target.clearColour(0, glm::vec4(0));
        target.clearStencil();
        countVolumes(frame, clipFromWorld, target);

        glStencilFunc(GL_EQUAL, 0, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        target.bind();
        resolve_.drawScreen();
        glDisable(GL_STENCIL_TEST);
    }

private:
    struct Draw {
        const VolumeMesh* mesh;
        std::size_t first, count;
    };

    static glm::dmat4 infiniteClip(const Frame& frame) {
        const Camera& camera = frame.snapshot.camera;
        const double aspect = static_cast<double>(frame.size.x) / frame.size.y;
        return infiniteProjection(camera.projection(aspect), camera.near) * camera.view();
    }

    const gl::Texture& drawDepth(const Frame& frame, const glm::mat4& clipFromWorld) {
        if (!ownDepth_ || ownDepth_->size() != frame.size) ownDepth_.emplace(gl::Format::Depth32FStencil8, frame.size);
        const gl::RenderTarget target({&*ownDepth_});
        target.clearDepth(1);
        target.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        depth_.set("clipFromWorld", clipFromWorld).use();
        frame.scene.draw();
        return *ownDepth_;
    }

    const VolumeMesh& volumeMesh(const std::shared_ptr<const Mesh>& mesh, const gl::SceneBuffers& scene) {
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

    /// The volumes of all placements, each with its own light position in object space.
    std::vector<Draw> buildVolumes(const Frame& frame) {
        const glm::dvec4 light = frame.snapshot.light.centreOnly().homogeneous();
        std::vector<Draw> draws;
        corners_.clear();
        for (const Batch& batch : frame.snapshot.batches) {
            const VolumeMesh& mesh = volumeMesh(batch.mesh, frame.scene);
            for (const Placement& placement : batch.placements) {
                const std::size_t first = corners_.size();
                appendShadowVolume(mesh.edges, glm::inverse(placement.world) * light, corners_);
                draws.push_back({&mesh, first, corners_.size() - first});
            }
        }
        return draws;
    }

    void countVolumes(const Frame& frame, const glm::mat4& clipFromWorld, const gl::RenderTarget& target) {
        const std::vector<Draw> draws = buildVolumes(frame);
        indices_.upload(corners_.data(), corners_.size() * sizeof(std::uint32_t));

        target.bind();
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_FALSE);
        glEnable(GL_DEPTH_CLAMP);
        glDisable(GL_CULL_FACE);
        glEnable(GL_STENCIL_TEST);
        glStencilMask(0xFF);
        glStencilFunc(GL_ALWAYS, 0, 0xFF);
        glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
        glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);

        volume_.set("clipFromWorld", clipFromWorld)
            .set("light", glm::vec4(frame.snapshot.light.centreOnly().homogeneous()))
            .use();
        for (std::size_t placement = 0; placement < draws.size(); ++placement) {
            const Draw& draw = draws[placement];
            draw.mesh->layout.bind();
            glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
            glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(draw.count), GL_UNSIGNED_INT,
                                                reinterpret_cast<const void*>(draw.first * sizeof(std::uint32_t)), 1,
                                                static_cast<GLuint>(placement));
        }
        gl::Context::current().tally().draws += draws.size();

        glDisable(GL_DEPTH_CLAMP);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    bool infinite_;
    gl::Program depth_, volume_, resolve_;
    std::unordered_map<const Mesh*, std::unique_ptr<VolumeMesh>> meshes_;
    std::vector<std::uint32_t> corners_;
    gl::Buffer indices_;
    std::optional<gl::Texture> ownDepth_;
};

} // namespace

Entry volumeZfail() {
    return {.id = "volume-zfail",
            .title = "Stencil shadow volumes, depth-fail",
            .source = {Seed::Course, "Practical and Robust Stenciled Shadow Volumes; Zápotocký 2.4.4"},
            .answer = Answer::Hard,
            .parameters = {{"far", "clamp", OneOf{{"clamp", "infinity"}},
                            "clamp depth, or put the far plane at infinity (P_inf)", "course, 3.2.1 and 3.4"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<VolumeZfail>(p); }};
}

} // namespace shadowbench::techniques
