// Shadow volumes counted in the stencil buffer: what the techniques of this folder share.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/shared/casters/shadow_volume.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace shadowbench::techniques {

/// Which of a volume's surfaces change a pixel's stencil value, and how (Zápotocký 2.4.3–2.4.5).
enum class VolumeTest {
    DepthFail,   // those behind the pixel's surface: back faces + 1, front faces − 1; the volume is closed by caps
    DepthPass,   // those before it: front faces + 1, back faces − 1; needs no caps
    ExclusiveOr, // those before it invert one bit
};

/// What every technique over `StencilVolumes` reports of a frame.
std::vector<Figure> volumeFigures();

class StencilVolumes {
public:
    explicit StencilVolumes(VolumeTest test);

    /// Writes 0 where the pixel's surface lies in the shadow volume of a placement, else 1. `light` is homogeneous.
    /// `depthStencil` holds the depth of what `clipFromWorld` shows; its stencil is overwritten.
    void render(const Frame& frame, const glm::dvec4& light, const glm::mat4& clipFromWorld, const gl::Texture& depthStencil,
                const gl::Texture& visibility);

    /// `volumeFigures` of the frame rendered last, against the same depth: its volumes are drawn again, and change nothing.
    [[nodiscard]] std::map<std::string, double> figures(const gl::Texture& depthStencil) const;

    /// The least that the frame rendered last needs of the GPU: its volumes, drawn again against the same depth.
    [[nodiscard]] std::vector<BarePass> bare(const gl::Texture& depthStencil) const;

private:
    /// A mesh's vertices twice, at w = 1 and at w = 0, and its edges.
    struct VolumeMesh {
        explicit VolumeMesh(std::shared_ptr<const Mesh> mesh);
        std::shared_ptr<const Mesh> source;
        EdgeMesh edges;
        gl::Buffer vertices;
        gl::VertexArray layout;
    };

    /// The volume of one placement, as a range of `corners_`: its caps, then its sides.
    struct Draw {
        const VolumeMesh* mesh;
        std::size_t first, caps, sides;
    };

    const VolumeMesh& volumeMesh(const std::shared_ptr<const Mesh>& mesh, const gl::SceneBuffers& scene);
    void buildVolumes(const Frame& frame, const glm::dvec4& light);
    void count(const Frame& frame, std::size_t first, std::size_t last) const;
    void drawVolumes(std::size_t first, std::size_t last) const;
    [[nodiscard]] std::uint64_t fragmentsPassing(unsigned depthFunction, const gl::Texture& depthStencil) const;
    void drawCaps(const Draw& draw, std::size_t placement) const;
    void drawCorners(std::size_t first, std::size_t count, std::size_t placement) const;
    void darken(const Frame& frame, const gl::RenderTarget& target) const;

    VolumeTest test_;
    gl::Program volume_, shadowed_;
    std::unordered_map<const Mesh*, std::unique_ptr<VolumeMesh>> meshes_;
    std::vector<Draw> draws_; // of the frame rendered last
    std::vector<std::uint32_t> corners_;
    gl::Buffer indices_;
};

} // namespace shadowbench::techniques
