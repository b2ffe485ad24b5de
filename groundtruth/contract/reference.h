// What every oracle is asked and answers. Nothing here depends on techniques.
#pragma once

#include "base/image.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>

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

/// What is asked. Hard: whether the light's centre is visible, 0 or 1. Soft: what is seen of the whole light, the visible
/// fraction of an area light or the share of an environment's irradiance that arrives, sampled by POV-Ray. PixelArea: the
/// mean of exact visibility of the light's centre over the part of each pixel's square in which the same surface is seen and
/// faces the light (docs/ground-truth.md, "Pixel areas"). Area, Irradiance and SolidAngle: the exact visible share of an
/// area light, by its area, by the irradiance that it brings to the receiver as a diffuse emitter, and by its solid angle
/// (docs/ground-truth.md, "Other definitions of soft visibility").
enum class Truth { Hard, Soft, PixelArea, Area, Irradiance, SolidAngle };
std::string_view name(Truth truth);      // "hard", "soft", "pixel-area", "area", "irradiance", "solid-angle"
Truth truthNamed(std::string_view name); // throws BadInput naming the valid ones and near matches

/// Whether a light has that truth: an environment, all around, has no hard one and no pixel areas, and only it and area
/// lights have a soft one. A line has no solid angle, and no side that emits.
bool hasTruth(const Light& light, Truth truth);

/// Throws BadInput, naming `whose` light it is and the truths that it has, unless it has this one.
void requireTruth(std::string_view whose, const Light& light, Truth truth);

/// Soft where the light has it, else Hard.
Truth usualTruth(const Light& light);

/// How the labels of Truth::Hard are found; each other truth has one oracle. Auto: Polygon where the receiver is planar,
/// Rays elsewhere. Plan: 2-D visibility, for plan-view scenes.
enum class Oracle { Auto, Polygon, Rays, Plan };
std::string_view name(Oracle oracle);
Oracle oracleNamed(std::string_view name); // throws BadInput naming the valid ones and near matches

struct Request {
    Snapshot snapshot;
    glm::ivec2 size;
    Truth truth;
    int samples = 1024; // of Soft: of an area light, directions of an environment
    Oracle oracle = Oracle::Auto;

    /// The usual truth of its light. There is no request without a snapshot: it would be of another light's truth.
    Request(Snapshot shown, glm::ivec2 pixels)
        : snapshot(std::move(shown)), size(pixels), truth(usualTruth(snapshot.light)) {}
    Request(Snapshot shown, glm::ivec2 pixels, Truth asked, int lightSamples = 1024)
        : snapshot(std::move(shown)), size(pixels), truth(asked), samples(lightSamples) {}

    /// The light that the truth is of.
    [[nodiscard]] Light light() const {
        const bool ofCentre = truth == Truth::Hard || truth == Truth::PixelArea;
        return ofCentre ? snapshot.light.centreOnly() : snapshot.light;
    }
};

} // namespace shadowbench::groundtruth
