// What every oracle is asked and answers. Nothing here depends on techniques.
#pragma once

#include "base/image.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>

namespace shadowbench::groundtruth {

/// What a pixel's centre ray hits.
enum class Surface : std::uint8_t {
    Background, // nothing
    FacesAway,  // a surface whose geometric side towards the eye does not face the light: unlit whatever the shadows
    Receiver,   // scored: for an area light, all of it lies above the tangent plane; for an environment, E₀ > 0
    OnEdge,     // a receiver exactly on a shadow edge (exact oracles only): no label is right, never scored
};

/// Exact primary hits: what each pixel centre sees. Row 0 at the top.
struct PrimaryHits {
    Image<std::uint32_t> id;       // Placement::id, 0 for background
    Image<glm::vec3> position;     // world position rounded to float
    Image<Surface> surface;        // Background, FacesAway or Receiver
    Image<std::uint32_t> triangle; // index in the placement's Mesh::triangles; 0 for background
};

/// Where the numbers of a reference come from.
struct Provenance {
    std::string oracle; // "polygon", "rays", "polygon+rays" (planar receivers + the others), "plan", "area", "povray",
                        // "irradiance", "solid-angle", "pixel-areas"
    std::string key;    // content hash of everything the reference depends on
    int samples = 0;    // light samples; 0 for exact oracles
    std::map<std::string, std::string> tools; // tool → version
    double seconds = 0;                       // wall time it took to compute
    /// povray: "primary_mismatch" (share of pixels where its hit mask and the exact primary hits differ), "light_mismatch"
    /// (share of pixels seen as fully lit or fully shadowed whose exact label for the light's centre says otherwise),
    /// "scale" (POV-Ray units per world unit), and its errors against the exact visible fraction, members of Certificate
    /// (groundtruth/certify/certificate.h): "certificate_points", "…_penumbra" and "…_wrong" (how many), "…_bias", "…_rms"
    /// and "…_largest" (over the penumbra points), "…_rms_half" and "…_rms_quarter" (with the first half and quarter of the
    /// samples), "…_independent" (what independent random samples would leave), "…_uneven", "…_bracket", "…_replayed", and
    /// what honest renders leave, "…_most_bias", "…_most_rms" and "…_most_fall". Under an environment light, which has no
    /// "light_mismatch", also "…_directions" (exact ones at each point).
    std::map<std::string, double> measured;
    std::string sources = {}; // hash of the code that computed it, 12 hex digits; no part of the key
};

struct Reference {
    Image<float> visibility; // visible fraction of the light in [0, 1] (0 or 1 for point and directional lights, but for
                             // pixel areas), of an area light's area unless the oracle is another share's; for an
                             // environment the share E/E₀ of the unoccluded irradiance
    Image<float> sigma;      // its standard uncertainty; 0 where exact. povray: estimated from the samples
                             // (groundtruth/povray/uncertainty.h), scaled to the certificate's rms error
    Image<Surface> surface;
    Image<std::uint32_t> id;
    Image<glm::vec3> position;
    Image<float>
        edgeDistance; // pixels from the centre to the nearest hard shadow edge on the same surface; infinity if none.
                      // Exact on planar receivers with `polygon`, else to half a pixel; all infinity for area lights.
    Provenance provenance;
};

/// Plan: 2-D visibility, for plan-view scenes. Area, Irradiance and SolidAngle: the exact visible share of an area light, by
/// its area, by the irradiance that it brings to the receiver as a diffuse emitter, and by its solid angle
/// (docs/ground-truth.md, "Other definitions of soft visibility").
enum class Oracle { Auto, Polygon, Rays, Plan, Area, PovRay, Irradiance, SolidAngle };
inline bool isExactShare(Oracle oracle) {
    return oracle == Oracle::Area || oracle == Oracle::Irradiance || oracle == Oracle::SolidAngle;
}
std::string_view name(Oracle oracle);
Oracle oracleNamed(std::string_view name); // throws BadInput naming the valid ones and near matches

struct Request {
    Snapshot snapshot;
    glm::ivec2 size{256, 256};
    /// Auto: povray for area lights and environments; else polygon where the receiver is planar, rays elsewhere.
    Oracle oracle = Oracle::Auto;
    int samples = 1024; // of area lights, and directions of environments, only
    /// Point and directional lights: not the label of each pixel's centre, but the mean of exact visibility over the part
    /// of its square in which the same surface is seen and faces the light (docs/ground-truth.md, "Pixel areas").
    bool pixelAreas = false;
};

} // namespace shadowbench::groundtruth
