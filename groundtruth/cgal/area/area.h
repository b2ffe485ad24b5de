// The visible fraction of an area light, exactly: what each pixel centre's surface point sees of the light
// (docs/ground-truth.md, "Exact visible fraction"). The geometry is that of groundtruth/cgal/hard/exact.h.
//
// A surface point P is the exact point where a pixel's ray meets its triangle's plane. Whatever lies strictly between P and
// the light's plane hides what is behind it; a triangle whose plane contains P hides nothing. Seen from P, each mesh leaves
// a chain of directed edges at which the number of covering triangles changes; projected from P onto the light they bound
// the hidden part, where that winding number is positive.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <memory>
#include <vector>

namespace shadowbench::groundtruth::geometry {
class SceneTriangles; // groundtruth/cgal/geometry/triangles.h
}

namespace shadowbench::groundtruth::area {

/// By what the parts of a light count: its area, the irradiance that they bring to the receiver as parts of a diffuse
/// emitter, or the solid angle under which they are seen. A line has neither of the last two.
enum class Share { Area, Irradiance, SolidAngle };

/// Raise it with every change that can alter a fraction: it is part of the key of each reference that needs one.
constexpr int codeVersion = 1;
constexpr int weightsCodeVersion = 1; // the same of shares of irradiance and solid angle

/// Visible share of the light at one surface point, in [0, 1]. low == high for rectangles and lines; for a disk the bracket
/// of an inscribed and a circumscribed polygon, of shares of its area at most 1e-4 wide. A point in the light's plane (on a
/// line light's line) sees the light edge-on and has no fraction: low = 0, high = 1.
struct VisibleFraction {
    double low, high;
};

class LightPoints; // groundtruth/cgal/area/area_points.h

/// Beside the fraction, how many points of each set of LightPoints are visible (none where the light is seen edge-on).
struct SampledFraction {
    VisibleFraction fraction{0, 1};
    std::vector<int> visible;
};

/// A snapshot prepared for queries; const use is thread-safe.
class AreaScene {
public:
    /// `threads`: how many work on an image; results do not depend on it. Throws InternalError unless light.isArea().
    explicit AreaScene(const Snapshot& snapshot, int threads = 2);
    /// With triangles that were made of the same snapshot, or of one with another camera and light only.
    AreaScene(const Snapshot& snapshot, std::shared_ptr<const geometry::SceneTriangles> triangles, int threads = 2);
    ~AreaScene();
    AreaScene(const AreaScene&) = delete;
    AreaScene& operator=(const AreaScene&) = delete;

    /// The fast form: filtered exact decisions, areas in double precision, within 1e-12 of `exactFraction`, or, where the
    /// sum over the edges is rounded by more than half of that, within twice its rounding; exactly 1 where nothing hides the
    /// light and 0 in the umbra. `pixel` must be a Surface::Receiver of `primary`, whose size is `size`; else InternalError.
    [[nodiscard]] VisibleFraction fraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary) const;

    /// The same of another share; InternalError for a line. Exactly 1 and 0 where `fraction` is.
    [[nodiscard]] VisibleFraction fraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary, Share share) const;

    /// The same with what the surface point sees of single points of the light: what a render that samples the light at them
    /// must show.
    [[nodiscard]] SampledFraction sampledFraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary,
                                                  const LightPoints& points) const;

    /// `fraction` by another derivation in rational numbers (clipped triangles in one arrangement), rounded at the end:
    /// checks `fraction`. Too slow for whole images.
    [[nodiscard]] VisibleFraction exactFraction(glm::ivec2 pixel, glm::ivec2 size, const PrimaryHits& primary) const;

    /// The fast form at all receivers of `primary`: visibility (middle of the bracket; 0 off the receivers), sigma (half the
    /// bracket plus the certified bound of the fast form's rounding), surface (OnEdge where the light is seen edge-on), id,
    /// position and edgeDistance (infinity) of `out`. InternalError for another share than that of the area of a line.
    void label(glm::ivec2 size, const PrimaryHits& primary, Reference& out, const Progress& progress = {},
               Share share = Share::Area) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace shadowbench::groundtruth::area
