// From transfer vectors to visibility, on the GPU: their dot products with the light, and for each pixel what its patch of
// points says of them.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/environment/surface_points.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"

#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Every surface point of a snapshot has a number, the irradiance E that reaches it; every patch another one, E₀, which
/// would reach it without shadows.
class PointShading {
public:
    /// Takes the points of the snapshot.
    void begin(const Snapshot& snapshot, std::size_t budget);

    /// The points are of no snapshot any more.
    void forget() { batches_.clear(); }

    /// Whether the snapshot shows the surfaces that the points lie on.
    [[nodiscard]] bool isOf(const Snapshot& snapshot) const;

    [[nodiscard]] const SurfacePoints& points() const { return points_; }
    [[nodiscard]] std::size_t pointCount() const { return points_.points.size(); }
    [[nodiscard]] std::size_t patchCount() const { return points_.patches.size(); }

    /// E of the points and E₀ of the patches, to be set: 32-bit floats.
    [[nodiscard]] gl::Buffer& irradiance() { return irradiance_; }
    [[nodiscard]] gl::Buffer& unshadowed() { return unshadowed_; }

    /// Sets the first `count` numbers of `results`: dot products of the vectors in `transfer`, coefficient by coefficient,
    /// with `light`.
    void setDotProducts(const gl::Buffer& results, std::size_t count, const gl::Buffer& transfer, const gl::Buffer& light,
                        std::size_t coefficients);

    /// Writes E / E₀, clamped to [0, 1], at every pixel of the G-buffer, as the pass "lookup".
    void lookUp(const Frame& frame, const gl::Texture& visibility);

private:
    void uploadPoints();

    std::vector<Batch> batches_; // of the snapshot that the points are of
    SurfacePoints points_;
    gl::Buffer surfaces_, patches_, rows_, irradiance_, unshadowed_;
    gl::Program dotProducts_ = gl::Program::compute("environment/dot_product.comp");
    gl::Program lookUp_{"gl/gbuffer.vert", "environment/lookup.frag"};
};

} // namespace shadowbench::techniques
