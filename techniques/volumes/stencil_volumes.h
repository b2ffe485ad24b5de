// Shadow volumes counted in the stencil buffer: what the techniques of this folder share.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/shared/casters/shadow_volume.h"
#include "techniques/shared/casters/volume_bounds.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace shadowbench::techniques {

/// Which of a volume's surfaces change a pixel's stencil value, and how (Zápotocký 2.4.3–2.4.5).
enum class VolumeTest {
    DepthFail,   // those behind the pixel's surface: back faces + 1, front faces − 1; the volume is closed by caps
    DepthPass,   // those before it: front faces + 1, back faces − 1; needs no caps
    PerCaster,   // as DepthPass where that is certain to count the same, else as DepthFail (Everitt–Kilgard 3.4)
    NearPlane,   // as DepthPass, from the near plane on, where the volumes around each pixel's own point are counted first
    ExclusiveOr, // those before it invert one bit
};

/// How far volumes are drawn and seen.
enum class FarPlane {
    OfCamera,   // depth is clamped there
    AtInfinity, // P_inf (Everitt–Kilgard 3.2.1)
};

/// The camera's projection · view with that far plane.
glm::dmat4 clipFromWorld(const Frame& frame, FarPlane far);

/// What every technique over `StencilVolumes` reports of a frame.
std::vector<Figure> volumeFigures();

class StencilVolumes {
public:
    explicit StencilVolumes(VolumeTest test, FarPlane far = FarPlane::OfCamera);

    /// Writes 0 where the pixel's surface lies in the shadow volume of a placement, else 1. `light` is homogeneous.
    /// `depthStencil` holds the depth of what `clipFromWorld(frame, far)` shows; its stencil is overwritten. Volumes that
    /// no pixel's ray meets are left out.
    void render(const Frame& frame, const glm::dvec4& light, const gl::Texture& depthStencil, const gl::Texture& visibility);

    /// `volumeFigures` of the frame rendered last, against the same depth: its volumes are drawn again, and change nothing.
    [[nodiscard]] std::map<std::string, double> figures(const gl::Texture& depthStencil) const;

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
        std::size_t placement; // its number in the snapshot
        VolumeTest test;       // never PerCaster
        std::size_t first, caps, sides;
    };
    using Draws = std::span<const Draw>;

    /// Where the pixels' rays run from the eye to the far plane, and to the near plane.
    struct View {
        ViewPyramid seen, beforeNear;
    };

    const VolumeMesh& volumeMesh(const std::shared_ptr<const Mesh>& mesh, const gl::SceneBuffers& scene);
    void buildVolumes(const Frame& frame, const glm::dvec4& light);
    [[nodiscard]] std::optional<VolumeTest> testFor(const EdgeMesh& mesh, const VolumeBounds& volume,
                                                    const View& view) const;
    void appendVolume(const VolumeMesh& mesh, std::size_t placement, VolumeTest test, Caps caps,
                      const glm::dvec4& objectLight);
    void setNearPlane(const glm::dmat4& clipFromWorld, const glm::dvec4& light);
    void drawNearPlane(Draws draws) const;
    [[nodiscard]] std::uint64_t fragmentsOnNearPlane(Draws draws, const gl::Texture& depthStencil) const;
    [[nodiscard]] static std::array<Draws, 2> byTest(Draws draws);
    void count(const Frame& frame, Draws draws) const;
    void drawCounting(Draws draws) const;
    void drawVolumes(Draws draws) const;
    [[nodiscard]] std::uint64_t fragmentsPassing(unsigned depthFunction, Draws draws, const gl::Texture& depthStencil) const;
    void drawCaps(const Draw& draw) const;
    void drawCorners(const Draw& draw, std::size_t first, std::size_t count) const;
    void darken(const Frame& frame, const gl::RenderTarget& target) const;

    VolumeTest test_;
    FarPlane far_;
    gl::Program volume_, shadowed_;
    std::optional<gl::Program> nearPlane_;
    std::unordered_map<const Mesh*, std::unique_ptr<VolumeMesh>> meshes_;
    std::vector<Draw> draws_; // of the frame rendered last, those of one test together
    std::size_t culled_ = 0;  // volumes that it left out
    std::vector<std::uint32_t> corners_;
    gl::Buffer indices_; // the corners
};

} // namespace shadowbench::techniques
