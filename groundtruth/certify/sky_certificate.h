// The error of a reference under an environment light against independent exact directions, measured at a sample of its
// pixels (docs/ground-truth.md, "Environment light").
#pragma once

#include "groundtruth/certify/certificate.h"
#include "groundtruth/cgal/hard/sky_irradiance.h"

namespace shadowbench::groundtruth {

/// Pixels that each reference under an environment is certified at, with many directions each: the rms error is then known
/// to some 4 %.
constexpr int skyCertificatePointCount = 512;

/// Directions that each certified pixel is decided with. They are drawn as those of the render, from every part of the light
/// alike, but scrambled in another way and shifted by another random vector at every pixel: what they err by themselves is
/// independent of the render and from pixel to pixel.
constexpr int certificateDirections = 16384;

/// Share of E₀ that arrives at `pixel` of `primary`, as the middle of a bracket of no width. `directions` in all, at least
/// povray::fewestOfASun of each sun.
ExactFraction exactSkyShare(const hard::ExactSky& scene, const EnvironmentLight& light, const PrimaryHits& primary,
                            int directions = certificateDirections);

/// Compares a render of `samples` parallel lights with exactSkyShare at certificatePoints. Certificate::uneven is 0: shares
/// of irradiance are no counts.
Certificate certifySky(const hard::ExactSky& scene, const EnvironmentLight& light, const povray::Render& image,
                       const PrimaryHits& primary, int samples, int points, int threads, const Progress& progress = {});

/// With so many directions, renders of usual scenes err by less than half of what requireSkyCertified allows.
constexpr int usualDirections = 2048;

/// Throws Inconclusive, with what is wrong in a sentence, unless the certificate is that of a valid render:
/// * no fully lit or fully shadowed pixel is further from the exact share than resolvedTolerance;
/// * with usualDirections or more, the mean error is at most 0.001 and the rms error 0.005; with fewer, as much more as the
///   error of low-discrepancy points grows, (usualDirections / N)^¾;
/// * the error falls from the first quarter of the directions to all of them: to 0.75 times, or below a fifth of those
/// bounds. With fewer than 32 partly lit points only the first is required.
void requireSkyCertified(const Certificate& certificate, int samples);

} // namespace shadowbench::groundtruth
