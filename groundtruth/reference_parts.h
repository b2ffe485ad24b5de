// What the oracles of several lights make a reference from.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"
#include "groundtruth/povray/povray.h"

#include <memory>

namespace shadowbench::groundtruth::geometry {
class SceneTriangles; // groundtruth/cgal/geometry/triangles.h
}

namespace shadowbench::groundtruth {

/// What all oracles of one request are prepared from, made once.
using Triangles = std::shared_ptr<const geometry::SceneTriangles>;

/// The part [from, to] of the whole progress.
Progress part(const Progress& progress, double from, double to);

/// A reference that knows its surfaces and nothing of the light.
Reference unlabelled(const PrimaryHits& primary);

/// Fills visibility and sigma of the receivers.
void fillReceivers(const Image<float>& visible, const Image<float>& sigma, Reference& reference);

/// Share of the pixels where POV-Ray's hit mask and the exact primary hits differ.
double primaryMismatch(const povray::Render& image, const PrimaryHits& primary);

/// Throws InternalError if that share is more than two oracles that see the same geometry can differ by; BadInput if the
/// camera's near or far plane explains it.
void requireSamePrimaryHits(const Request& request, const povray::Render& image, double mismatch);

} // namespace shadowbench::groundtruth
