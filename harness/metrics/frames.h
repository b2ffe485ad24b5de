// What metrics are computed from. V is a technique's visibility, V* the truth's, M the receiver mask; all images of one
// struct have the same size.
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"
#include "harness/metrics/flip.h"
#include "scene/snapshot.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace shadowbench::metrics {

/// What the rasteriser drew at each pixel (read back from the G-buffer).
struct Drawn {
    Image<std::uint32_t> id;
    Image<glm::vec3> position;
};

/// The receiver mask M: the truth's receivers whose primary hit the rasteriser agrees on.
struct Mask {
    Image<std::uint8_t> scored; // 1 in M
    double primaryMismatch = 0; // share of all pixels whose primary hits disagree
    std::size_t count = 0;      // pixels in M
    bool aligned = true;        // no more disagree than rounding explains
};

/// Primary hits agree when the surface ids are equal and, unless both are background, the distances from `eye` differ by at
/// most 0.2 % plus 0.1 mm (what 32-bit positions and a grazing view cost). Rounding explains 0.1 % of all pixels, and in a
/// tiny image up to four that lie on an edge, where a neighbour's hit is the one that was drawn.
Mask receiverMask(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye);

/// A rendered frame with its truth.
struct ScoredFrame {
    const Image<float>& v;
    const groundtruth::Reference& truth;
    const Mask& mask;
};

/// The linear light that a picture has at each pixel: what is there without the scene's light, and what that adds where V is
/// 1. The object's flat colour reflects diffusely; of the light on a white plane that faces the scene's, a fifth comes from
/// all around, as beside the sun a clear sky gives, and both together are 1. An area light shines from its centre, an
/// environment from its mean direction; nothing fades with distance. Background is black.
struct Shading {
    Image<glm::vec3> ambient, direct;
};
inline constexpr float ambientShare = 0.2F;
inline constexpr glm::vec3 shownBackground{0.02F, 0.03F, 0.06F}; // to people: bluish, so that it is not taken for a shadow
Shading shading(const Snapshot& snapshot, const Drawn& drawn, const Image<glm::vec3>& normals);

/// The picture with visibility `v`.
Image<glm::vec3> shaded(const Shading& shading, const Image<float>& v);

/// A rendered frame as a picture, and the one with V* in place of V.
struct ShadedFrame {
    ScoredFrame frame;
    const Shading& shading;
    const FlipPicture& truth;
};

/// Where a world point lies in a technique's map, in texels; nothing if it lies in none.
using MapPoint = std::function<std::optional<glm::dvec2>(const glm::dvec3&)>;

/// A frame with the technique's map.
struct MappedFrame {
    const Camera& camera;
    const Image<glm::vec3>& positions;
    const Image<glm::vec3>& normals;
    const Mask& mask;
    const MapPoint& mapPoint;
};

/// All still frames of a technique with history, from an empty one.
struct StillFrames {
    const std::vector<Image<std::uint8_t>>& pictures; // V in 1/255
    const std::vector<double>& errors;                // rmse of each against the technique's own truth
    const Mask& mask;                                 // of the last
};

/// V in 1/255.
Image<std::uint8_t> inBytes(const Image<float>& v);

/// A moving frame with the one before.
struct FramePair {
    ScoredFrame now, before;
    Image<glm::vec2> warp; // from `now` to `before`
};
struct MovingFrames {
    std::vector<FramePair> pairs;
    bool remembers = false; // the technique keeps a history
    double motion = 0;      // degrees, summed over the pairs
};

/// The last still frame, drawn from an empty history with one seed after the other. M is the same for all.
struct SeedFrames {
    const std::vector<Image<float>>& images;
    const groundtruth::Reference& truth;
    const Mask& mask;
};

/// Where each pixel of `now` was in the previous frame, by exact reprojection of the truth's primary hits (moving placements
/// by their own motion, on meshes that deform with their triangle): image position in pixels, NaN where it left the image or
/// was disoccluded, that is where none of the 2 × 2 pixels of `before` around it shows the same surface at the same distance
/// from the eye within 0.5 %.
Image<glm::vec2> warp(const Snapshot& now, glm::ivec2 size, const groundtruth::Reference& truth,
                      const groundtruth::Reference& before);

/// How far the scene moves from the frame before, in degrees: the mean angle that the view of a surface point turns in the
/// camera (by the camera's path or the object's), over the pixels that `warp` follows, and, seen from the middle of these
/// points, the angle that the light's centre turns and the largest one that a corner of a moving mesh's bounds does. 0
/// where nothing moves, or no pixel is followed.
double motion(const Snapshot& now, const Light& before, const groundtruth::Reference& truth, const Image<glm::vec2>& warp);

/// What was seen of a level-of-detail technique, frame by frame; never empty. Colours are in [0, 1].
struct Walk {
    // While camera and instances stand and levels alone change, so that lod-full's picture stays as it is; from frame 1:
    std::vector<double> standingChange;      // meanChange from the frame before
    std::vector<std::size_t> standingRegion; // largestChangedRegion
    // Along the walk:
    std::vector<double> change;     // meanChange from the frame before less that of lod-full; from frame 1
    std::vector<double> square;     // meanSquare of the difference from lod-full
    std::vector<double> speckle;    // over the pixels that see a transition
    std::vector<double> primitives; // drawn
    double referenceSpeckle = 0;    // of lod-full, over all frames
    std::size_t maskPixels = 0;     // that see a transition, in all frames
    std::size_t transitions = 0;    // most instances in transition at once
    double orderSquare = 0;         // meanSquare of what drawing all triangles the other way round changes
};

} // namespace shadowbench::metrics
