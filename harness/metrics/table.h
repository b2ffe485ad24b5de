// The one table of metrics, which records, their schema, CSV and bounds, comparisons, history and `list metrics` read.
//
// Adding a metric is two edits: its function, declared in scores.h and defined beside its like (hard.cpp for labels,
// soft.cpp for graded visibility, stability.cpp for frames over time, walk.cpp for levels of detail), and its line in
// `table`. The line's place is its place in the record; lines of one object of the record stand together.
#pragma once

#include "harness/metrics/metric.h"
#include "harness/metrics/scores.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::metrics {

// Rendering is the same to the bit from run to run, so the only allowance that exact truths need is for what an innocent
// change of rounding may do: a pixel or two whose centre lies on an edge, or two pixels beside an edge of a thousand.
inline constexpr double strayEdge = 0.002;  // px
inline constexpr double strayTail = 0.02;   // px: of one point in twenty, on which the 95th percentile rests
inline constexpr double strayWidth = 0.004; // two points in a thousand, each off by the most that is counted: 2

// Why lines are not judged, where several have one reason.
inline constexpr std::string_view noisyTime = "another run gives another value: frames in turns are judged instead";
inline constexpr std::string_view behindScores = "the numbers behind scores that are judged";
inline constexpr std::string_view onDemand = "measured by `run --seeds` alone: accuracy.rmse is judged";
inline constexpr std::string_view classSize = "what shares are of: a property of scene and truth";

// A line states what differs from the columns' defaults in metric.h; clang-format would give each column a line.
// clang-format off
inline constexpr auto table = std::to_array<Metric>({
    {.path = "lod.pop", .unit = "1", .range = range::size, .about = Class::Flicker, .bound = "pop",
     .allowance = Allowance{.relative = 0.01}, .computed = OfWalk{of<standingPop>},
     .meaning = "levels of detail: largest mean change of colour from frame to frame while levels alone change"},
    {.path = "lod.changed_region", .unit = "pixels", .range = range::count, .about = Class::Flicker, .allowance = Allowance{.relative = 0.01, .absolute = 2},
     .computed = OfWalk{of<standingRegion>},
     .meaning = "levels of detail: the same, largest connected region that changes by more than 30/255"},
    {.path = "lod.walk_pop", .unit = "1", .about = Class::Flicker, .allowance = Allowance{.pixels = 2, .relative = 0.01},
     .computed = OfWalk{of<walkPop>},
     .meaning = "levels of detail: largest mean change of colour along the walk beyond lod-full's; coarse levels alias less "
                "and change less"},
    {.path = "lod.colour_error", .unit = "1", .range = range::size, .about = Class::Colour,
     .allowance = Allowance{.relative = 0.01}, .computed = OfWalk{of<colourError>},
     .meaning = "levels of detail: rms difference from lod-full over the walk"},
    {.path = "lod.noise", .unit = "1", .optional = true, .about = Class::Colour, .allowance = Allowance{.relative = 0.01},
     .computed = OfWalk{of<noise>},
     .meaning = "levels of detail: mean distance from the 3×3 median beyond lod-full's, over pixels in transition"},
    {.path = "lod.order_error", .unit = "1", .range = range::size, .about = Class::Colour,
     .allowance = Allowance{.relative = 0.01}, .computed = OfWalk{of<orderError>},
     .meaning = "levels of detail: rms difference from the same with all triangles drawn the other way round"},
    {.path = "lod.transitions", .unit = "instances", .range = range::count, .unjudged = "a property of the walk and of its bands, neither good nor bad",
     .computed = OfWalk{of<transitions>},
     .meaning = "levels of detail: most instances in transition at once"},
    {.path = "lod.primitives", .unit = "primitives", .range = range::size, .about = Class::Work, .allowance = Allowance{.relative = 0.005},
     .computed = OfWalk{of<primitives>},
     .meaning = "levels of detail: primitives drawn in a frame, mean"},
    {.path = "lod.primitive_change", .unit = "share", .range = range::size, .about = Class::Work, .allowance = Allowance{.relative = 0.01},
     .computed = OfWalk{of<primitiveChange>},
     .meaning = "levels of detail: largest change of the primitives drawn from frame to frame"},
    {.path = "lod.time.median", .unit = "ms", .range = range::size, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "levels of detail: time of a frame without the G-buffer; processor time where drawing has none of its own"},
    {.path = "lod.time.ratio", .unit = "ratio", .range = range::size, .noisy = true, .about = Class::Time,
     .unjudged = noisyTime,
     .meaning = "levels of detail: time of a frame as a multiple of lod-switch's, median over the frames"},
    {.path = "lod.time.spread", .unit = "share", .range = range::size, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "levels of detail: median change of the time from one frame to the next"},
    {.path = "lod.by_frame.pop", .unit = "1", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .meaning = "lod.pop's change from each frame to the next"},
    {.path = "lod.by_frame.walk_pop", .unit = "1", .list = true, .optional = true,
     .unjudged = behindScores,
     .meaning = "lod.walk_pop's change from each frame to the next"},
    {.path = "lod.by_frame.primitives", .unit = "primitives", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .meaning = "primitives drawn in each frame of the walk"},
    {.path = "lod.by_frame.milliseconds", .unit = "ms", .range = range::size, .list = true, .optional = true, .noisy = true,
     .unjudged = behindScores,
     .meaning = "time of each frame of the walk: the least of all rounds"},

    {.path = "accuracy.mismatch", .unit = "share", .range = range::share, .optional = true, .about = Class::Labels,
     .bound = "mismatch", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.labelled"},
     .computed = OfLabels{part<labelErrors, &LabelErrors::mismatch>},
     .meaning = "receiver pixels whose rounded visibility differs from the exact label"},
    {.path = "accuracy.mismatch_unrounded", .unit = "share", .range = range::share, .optional = true,
     .about = Class::Labels, .bound = "mismatch_unrounded", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.labelled"},
     .computed = OfLabels{part<labelErrors, &LabelErrors::unrounded>},
     .meaning = "the same without rounding: mean distance of the visibility from the exact label"},
    {.path = "accuracy.mismatch_off_edge", .unit = "share", .range = range::share, .optional = true, .about = Class::Labels,
     .bound = "mismatch_off_edge", .allowance = Allowance{.pixels = 1, .of = "accuracy.pixels.off_edge"},
     .computed = OfLabels{part<labelErrors, &LabelErrors::mismatchOffEdge>},
     .meaning = "the same more than half a pixel away from an exact shadow edge"},
    {.path = "accuracy.false_shadow", .unit = "share", .range = range::share, .optional = true, .about = Class::FalseShadow,
     .bound = "false_shadow", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.lit"},
     .computed = OfLabels{part<labelErrors, &LabelErrors::falseShadow>},
     .meaning = "lit pixels called shadowed (acne, over-shadow)"},
    {.path = "accuracy.leak", .unit = "share", .range = range::share, .optional = true, .about = Class::Leak,
     .bound = "leak", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.shadowed"}, .computed = OfLabels{part<labelErrors, &LabelErrors::leak>},
     .meaning = "shadowed pixels called lit (peter-panning, light leak)"},
    {.path = "accuracy.edge_error.mean", .unit = "pixels", .range = range::size, .optional = true, .about = Class::Edge,
     .bound = "edge_error", .allowance = Allowance{.relative = 0.01, .absolute = strayEdge},
     .computed = OfLabels{part<edgeError, &EdgeError::mean>},
     .meaning = "displacement of the technique's shadow edge from the exact one, both ways, without islands, mean"},
    {.path = "accuracy.edge_error.median", .unit = "pixels", .range = range::size, .optional = true, .about = Class::Edge,
     .bound = "edge_error_median", .allowance = Allowance{.relative = 0.01, .absolute = strayEdge},
     .computed = OfLabels{part<edgeError, &EdgeError::median>}, .meaning = "the same, median"},
    {.path = "accuracy.edge_error.p95", .unit = "pixels", .range = range::size, .optional = true,
     .about = Class::Edge, .allowance = Allowance{.relative = 0.05, .absolute = strayTail},
     .computed = OfLabels{part<edgeError, &EdgeError::p95>}, .meaning = "the same, 95th percentile"},
    {.path = "accuracy.edge_error.hausdorff", .unit = "pixels", .range = range::size, .optional = true,
     .unjudged = "one stray pixel may put it anywhere: mean, p95 and mismatch off the edge are judged",
     .computed = OfLabels{part<edgeError, &EdgeError::hausdorff>}, .meaning = "the same, largest, missing edges too"},
    {.path = "accuracy.edge_error.signed", .unit = "pixels", .optional = true, .about = Class::Edge,
     .allowance = Allowance{.relative = 0.01, .absolute = strayEdge, .magnitude = true},
     .computed = OfLabels{part<edgeError, &EdgeError::signedMean>},
     .meaning = "the same, mean with a sign: − shadow too small, + too large"},
    {.path = "accuracy.edge_error.missing", .unit = "share", .range = range::share, .optional = true, .about = Class::Edge,
     .bound = "missing_edges", .allowance = Allowance{.pixels = 2},
     .computed = OfLabels{part<edgeError, &EdgeError::missing>},
     .meaning = "exact shadow edge with none of the technique's within 8 pixels"},
    {.path = "accuracy.edge_error.islands", .unit = "count", .range = range::count, .optional = true, .about = Class::Edge,
     .bound = "islands", .allowance = Allowance{.absolute = 1},
     .computed = OfLabels{part<edgeError, &EdgeError::islands>},
     .meaning = "regions of wrong labels more than 2 pixels away from every exact edge: acne, holes"},
    {.path = "accuracy.rmse", .unit = "1", .range = range::size, .optional = true, .about = Class::Penumbra, .bound = "rmse",
     .allowance = Allowance{.truth = TruthError::Rms, .of = "accuracy.pixels.graded"},
     .computed = OfVisibility{part<visibilityErrors, &VisibilityErrors::rmse>}, .meaning = "root mean square of V − V*"},
    {.path = "accuracy.mae", .unit = "1", .range = range::size, .optional = true, .about = Class::Penumbra, .bound = "mae",
     .allowance = Allowance{.truth = TruthError::Mean, .of = "accuracy.pixels.graded"},
     .computed = OfVisibility{part<visibilityErrors, &VisibilityErrors::mae>}, .meaning = "mean of abs(V − V*)"},
    {.path = "accuracy.psnr", .unit = "dB", .optional = true,
     .unjudged = "accuracy.rmse in decibels",
     .computed = OfVisibility{part<visibilityErrors, &VisibilityErrors::psnr>}, .meaning = "peak signal to noise"},
    {.path = "accuracy.bad30", .unit = "share", .range = range::share, .optional = true, .about = Class::Penumbra,
     .bound = "bad30", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.graded"}, .computed = OfVisibility{of<bad30>},
     .meaning = "pixels with abs(V − V*) > 30/255 (EGSR 2007)"},
    {.path = "accuracy.bad8", .unit = "share", .range = range::share, .optional = true, .about = Class::Penumbra,
     .bound = "bad8", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.graded", .relative = 0.01},
     .computed = OfVisibility{of<bad8>}, .meaning = "pixels with abs(V − V*) > 8/255"},
    {.path = "accuracy.ssim", .unit = "1", .range = range::correlation, .optional = true, .about = Class::Penumbra,
     .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.graded", .relative = 0.01, .best = 1},
     .computed = OfVisibility{of<ssim>},
     .meaning = "structural similarity, 11×11 Gaussian"},
    {.path = "accuracy.penumbra_rmse", .unit = "1", .range = range::size, .optional = true, .about = Class::Penumbra,
     .bound = "penumbra_rmse", .allowance = Allowance{.truth = TruthError::Rms, .of = "accuracy.pixels.penumbra"}, .computed = OfVisibility{of<penumbraRmse>},
     .meaning = "rmse over the penumbra dilated by 2 pixels"},
    {.path = "accuracy.penumbra_width_error", .unit = "relative", .range = range::size, .optional = true,
     .about = Class::Penumbra, .bound = "penumbra_width_error", .allowance = Allowance{.relative = 0.01, .absolute = strayWidth},
     .computed = OfVisibility{of<penumbraWidthError>},
     .meaning = "error of the penumbra's width along its edge normals"},
    {.path = "accuracy.umbra_leak", .unit = "1", .optional = true, .about = Class::Leak, .bound = "umbra_leak",
     .allowance = Allowance{.pixels = 1, .of = "accuracy.pixels.umbra"}, .computed = OfVisibility{of<umbraLeak>},
     .meaning = "mean visibility over the umbra eroded by 2 pixels"},
    {.path = "accuracy.umbra", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "good by its distance from accuracy.true_umbra, which leak and penumbra scores measure",
     .computed = OfVisibility{part<umbra, &Umbra::drawn>}, .meaning = "receiver pixels without light"},
    {.path = "accuracy.true_umbra", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "a property of the truth",
     .computed = OfVisibility{part<umbra, &Umbra::exact>}, .meaning = "the same of the truth"},
    {.path = "accuracy.penumbra_plateau", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "bands and noise are traded for each other: the errors decide",
     .computed = OfVisibility{part<grain, &Grain::plateau>},
     .meaning = "bands: 2×2 squares of graded pixels whose values agree within 1/255"},
    {.path = "accuracy.penumbra_noise", .unit = "1", .range = range::size, .optional = true,
     .unjudged = "bands and noise are traded for each other: the errors decide",
     .computed = OfVisibility{part<grain, &Grain::noise>},
     .meaning = "noise: mean distance of graded pixels from the median of their 3×3"},
    {.path = "accuracy.unresolved", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "says what the truth leaves open, not how good the technique is",
     .computed = OfVisibility{of<unresolved>},
     .meaning = "pixels whose error is below three times the truth's own uncertainty"},
    {.path = "accuracy.z_correctness", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "another reading of the errors that bad8 and bad30 judge",
     .computed = OfVisibility{part<pictureCorrectness, &PictureCorrectness::within8>},
     .meaning = "pixels of the frame whose grey is at most 8 of 255 off the truth's (Zápotocký's Table 5.4)"},
    {.path = "accuracy.z_correctness_2", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "another reading of the errors that bad8 and bad30 judge",
     .computed = OfVisibility{part<pictureCorrectness, &PictureCorrectness::within2>}, .meaning = "the same, at most 2"},
    {.path = "accuracy.z_correctness_16", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "another reading of the errors that bad8 and bad30 judge",
     .computed = OfVisibility{part<pictureCorrectness, &PictureCorrectness::within16>}, .meaning = "the same, at most 16"},
    {.path = "accuracy.z_correctness_30", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "another reading of the errors that bad8 and bad30 judge",
     .computed = OfVisibility{part<pictureCorrectness, &PictureCorrectness::within30>}, .meaning = "the same, at most 30"},
    {.path = "accuracy.pixel_area.rmse", .unit = "1", .range = range::size, .optional = true, .about = Class::Penumbra,
     .bound = "pixel_area_rmse", .allowance = Allowance{.truth = TruthError::Rms, .of = "accuracy.pixels.labelled"},
     .computed = OfPixelAreas{of<rmse>},
     .meaning = "root mean square of V − C*, the mean of exact visibility over the pixel's square: what a filter is for"},
    {.path = "accuracy.pixel_area.bad30", .unit = "share", .range = range::share, .optional = true,
     .about = Class::Penumbra, .bound = "pixel_area_bad30", .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.labelled"},
     .computed = OfPixelAreas{of<bad30>}, .meaning = "pixels with abs(V − C*) > 30/255"},
    {.path = "accuracy.pixel_area.ssim", .unit = "1", .range = range::correlation, .optional = true,
     .about = Class::Penumbra,
     .allowance = Allowance{.pixels = 2, .of = "accuracy.pixels.labelled", .relative = 0.01, .best = 1},
     .computed = OfPixelAreas{of<ssim>}, .meaning = "structural similarity with C*"},
    {.path = "accuracy.pixels.labelled", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfLabels{part<labelledPixels, &LabelledPixels::all>}, .meaning = "receiver pixels with an exact label"},
    {.path = "accuracy.pixels.lit", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfLabels{part<labelledPixels, &LabelledPixels::lit>}, .meaning = "those that are lit"},
    {.path = "accuracy.pixels.shadowed", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfLabels{part<labelledPixels, &LabelledPixels::shadowed>}, .meaning = "those in shadow"},
    {.path = "accuracy.pixels.off_edge", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfLabels{part<labelledPixels, &LabelledPixels::offEdge>},
     .meaning = "those more than half a pixel away from an exact shadow edge"},
    {.path = "accuracy.pixels.graded", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfVisibility{part<gradedPixels, &GradedPixels::all>},
     .meaning = "receiver pixels whose visibility is compared"},
    {.path = "accuracy.pixels.penumbra", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfVisibility{part<gradedPixels, &GradedPixels::penumbra>},
     .meaning = "those in the penumbra dilated by 2 pixels"},
    {.path = "accuracy.pixels.umbra", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfVisibility{part<gradedPixels, &GradedPixels::umbra>},
     .meaning = "those in the umbra eroded by 2 pixels"},
    {.path = "accuracy.primary_mismatch", .unit = "share", .range = range::share,
     .about = Class::Labels, .allowance = Allowance{.pixels = 2},
     .meaning = "pixels where rasteriser and truth see different surfaces; above 0.1 % nothing is scored"},

    {.path = "aliasing.median", .unit = "pixels", .range = range::size, .unjudged = "of the map, not of the image: labels and edges show what it does there",
     .computed = OfMap{part<aliasing, &Aliasing::median>},
     .meaning = "that one texel of the technique's map covers where it is stretched most, median over the receivers"},
    {.path = "aliasing.p95", .unit = "pixels", .range = range::size, .unjudged = "of the map, not of the image: labels and edges show what it does there",
     .computed = OfMap{part<aliasing, &Aliasing::p95>},
     .meaning = "the same, 95th percentile"},
    {.path = "aliasing.mapped", .unit = "share", .range = range::share, .unjudged = "of the map, not of the image: labels and edges show what it does there",
     .computed = OfMap{part<aliasing, &Aliasing::mapped>},
     .meaning = "receiver pixels that lie in a map"},

    {.path = "off_geometry_edges.mismatch", .unit = "share", .range = range::share, .optional = true, .about = Class::Labels,
     .allowance = Allowance{.pixels = 2, .of = "off_geometry_edges.pixels"},
     .meaning = "another renderer's images without hits: mismatch over the receivers at which no edge of geometry is seen"},
    {.path = "off_geometry_edges.rmse", .unit = "1", .range = range::size, .about = Class::Penumbra,
     .allowance = Allowance{.truth = TruthError::Rms, .of = "off_geometry_edges.pixels"},
     .meaning = "the same: root mean square of V − V*"},
    {.path = "off_geometry_edges.pixels", .unit = "pixels", .range = range::count, .unjudged = classSize,
     .meaning = "those receivers"},
    {.path = "stability.flicker.mean", .unit = "1", .range = range::size, .about = Class::Flicker, .bound = "flicker",
     .allowance = Allowance{.truth = TruthError::Mean, .of = "stability.pixels.compared", .relative = 0.01},
     .computed = OfMovingAreas{part<flicker, &Flicker::mean>},
     .meaning = "change between moving frames beyond that of the true pixel areas, after exact reprojection, mean"},
    {.path = "stability.flicker.p95", .unit = "1", .range = range::size,
     .unjudged = "0 or 1 of hard shadows, as one pixel in twenty changes or not: the mean is judged",
     .computed = OfMovingAreas{part<flicker, &Flicker::p95>}, .meaning = "the same, 95th percentile"},
    {.path = "stability.flicker.floor", .unit = "1", .range = range::size, .optional = true,
     .unjudged = "a property of the truth",
     .computed = OfMovingAreas{part<flicker, &Flicker::floor>},
     .meaning = "the mean for an image without shadows, which never changes: none's"},
    {.path = "stability.flip_rate", .unit = "share", .range = range::share, .optional = true, .about = Class::Flicker,
     .bound = "flip_rate", .allowance = Allowance{.pixels = 2, .of = "stability.pixels.compared", .relative = 0.01}, .computed = OfMovingFrames{of<flipRate>},
     .meaning = "reprojected pixels that change class while the truth does not"},
    {.path = "stability.moving_rmse", .unit = "1", .range = range::size, .optional = true, .about = Class::Flicker,
     .bound = "moving_rmse", .allowance = Allowance{.truth = TruthError::Rms, .of = "stability.pixels.moving", .relative = 0.01},
     .computed = OfMovingFrames{part<movingErrors, &MovingErrors::all>},
     .meaning = "root mean square of V − V* over the moving frames: what flicker does not see, a steady trail"},
    {.path = "stability.disocclusion_error", .unit = "1", .range = range::size, .optional = true, .about = Class::Flicker,
     .bound = "disocclusion_error", .allowance = Allowance{.truth = TruthError::Rms, .of = "stability.pixels.disoccluded", .relative = 0.01},
     .computed = OfMovingFrames{part<movingErrors, &MovingErrors::disoccluded>},
     .meaning = "the same over the pixels in their first frame"},
    {.path = "stability.ghost_half_life", .unit = "frames", .range = range::size, .optional = true, .about = Class::Flicker,
     .bound = "ghost_half_life", .allowance = Allowance{.relative = 0.05, .absolute = 0.05},
     .computed = OfMovingFrames{of<ghostHalfLife>},
     .meaning = "frames after which what a history still shows of shadows that came or went has halved"},
    {.path = "stability.seeds.rmse", .unit = "1", .range = range::size, .optional = true, .unjudged = onDemand,
     .computed = OfSeeds{part<seedErrors, &SeedErrors::rmse>},
     .meaning = "root mean square of V − V* over pixels and seeds, of what depends on the seed"},
    {.path = "stability.seeds.bias", .unit = "1", .optional = true, .unjudged = onDemand,
     .computed = OfSeeds{part<seedErrors, &SeedErrors::bias>},
     .meaning = "the same, mean of V − V*: too bright or too dark"},
    {.path = "stability.seeds.systematic", .unit = "1", .range = range::size, .optional = true, .unjudged = onDemand,
     .computed = OfSeeds{part<seedErrors, &SeedErrors::systematic>},
     .meaning = "the same, what all seeds have in common: more samples of the same kind leave it"},
    {.path = "stability.seeds.noise", .unit = "1", .range = range::size, .optional = true, .unjudged = onDemand,
     .computed = OfSeeds{part<seedErrors, &SeedErrors::noise>},
     .meaning = "the same, standard deviation of a pixel over the seeds"},
    {.path = "stability.reuse", .unit = "share", .range = range::share, .optional = true,
     .unjudged = "a property of the camera's path",
     .computed = OfMovingFrames{of<reuse>}, .meaning = "surface pixels of the moving frames that the frame before saw, too"},
    {.path = "stability.pixels.compared", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfMovingFrames{part<movingPixels, &MovingPixels::compared>},
     .meaning = "reprojected pixels of the moving frames that the frame before scores, too"},
    {.path = "stability.pixels.moving", .unit = "pixels", .range = range::count, .optional = true, .unjudged = classSize,
     .computed = OfMovingFrames{part<movingPixels, &MovingPixels::all>}, .meaning = "receiver pixels of the moving frames"},
    {.path = "stability.pixels.disoccluded", .unit = "pixels", .range = range::count, .optional = true,
     .unjudged = classSize, .computed = OfMovingFrames{part<movingPixels, &MovingPixels::disoccluded>},
     .meaning = "those in their first frame"},
    {.path = "stability.convergence", .unit = "frames", .range = range::frameNumber, .optional = true,
     .about = Class::Flicker, .bound = "convergence", .allowance = Allowance{.relative = 0.05, .absolute = 1}, .computed = OfStillFrames{of<convergence>},
     .meaning = "still frames from an empty history until the error stays within 5 % of its steady state"},
    {.path = "stability.by_frame.mismatch", .unit = "share", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .computed = LabelsByFrame{part<labelErrors, &LabelErrors::mismatch>},
     .meaning = "accuracy.mismatch of each still frame from an empty history"},
    {.path = "stability.by_frame.rmse", .unit = "1", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .computed = VisibilityByFrame{of<rmse>}, .meaning = "accuracy.rmse of each still frame from an empty history"},
    {.path = "stability.by_frame.bad30", .unit = "share", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .computed = VisibilityByFrame{of<bad30>}, .meaning = "accuracy.bad30 of each still frame from an empty history"},
    {.path = "stability.by_frame.changed", .unit = "share", .range = range::size, .list = true, .optional = true,
     .unjudged = behindScores,
     .computed = ByStillFrame{changedByFrame},
     .meaning = "pixels of each still frame from an empty history that are more than 30/255 off the technique's last one"},

    {.path = "cost.time.median", .unit = "ms", .range = range::size, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "wall time of a frame, G-buffer included, over interleaved rounds, median"},
    {.path = "cost.time.p95", .unit = "ms", .range = range::size, .noisy = true, .unjudged = noisyTime,
     .meaning = "the same, 95th percentile"},
    {.path = "cost.time.mad", .unit = "ms", .range = range::size, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "the same, median absolute deviation"},
    {.path = "cost.time.ratio", .unit = "ratio", .range = range::size, .noisy = true, .about = Class::Time,
     .unjudged = noisyTime,
     .meaning = "time of a frame as a multiple of sm-uniform's in the same rounds, both with the G-buffer"},
    {.path = "cost.time.floor_ratio", .unit = "share", .range = range::size, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "of the frame's time that the G-buffer alone takes"},
    {.path = "cost.time.base_ratio", .unit = "ratio", .range = range::size, .optional = true, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "time of a frame as a multiple of that of the technique's own base (history over its base map)"},
    {.path = "cost.time.bare", .unit = "ms", .range = range::size, .optional = true, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "wall time of the least that the frame needs, G-buffer included: its passes with nothing else"},
    {.path = "cost.time.bare_ratio", .unit = "ratio", .range = range::size, .optional = true, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "time of a frame without the processor's share as a multiple of that"},
    {.path = "cost.time.processor", .unit = "share", .range = range::share, .optional = true, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "of the frame's time in passes that ask nothing of the GPU, and between passes"},
    {.path = "cost.time.samples", .unit = "ms", .range = range::size, .list = true, .optional = true, .noisy = true,
     .unjudged = noisyTime,
     .meaning = "wall time of the frame of each round"},
    {.path = "cost.instructions", .unit = "instructions", .range = range::count, .optional = true,
     .about = Class::Instructions, .allowance = Allowance{.relative = 0.005},
     .meaning = "processor instructions of a frame, counted by Valgrind"},
    {.path = "cost.work.fragments", .unit = "count", .range = range::count,
     .about = Class::Work, .allowance = Allowance{.relative = 0.005},
     .meaning = "fragment shader invocations of a frame"},
    {.path = "cost.work.vertices", .unit = "count", .range = range::count, .about = Class::Work, .allowance = Allowance{.relative = 0.005},
     .meaning = "vertices drawn in a frame"},
    {.path = "cost.work.primitives", .unit = "count", .range = range::count, .about = Class::Work, .allowance = Allowance{.relative = 0.005},
     .meaning = "primitives drawn in a frame"},
    {.path = "cost.work.draws", .unit = "count", .range = range::count, .about = Class::Work, .allowance = Allowance{},
     .meaning = "draw calls of a frame"},
    {.path = "cost.work.passes", .unit = "count", .range = range::count, .about = Class::Work, .allowance = Allowance{},
     .meaning = "render passes of a frame"},
    {.path = "cost.work.bytes", .unit = "bytes", .range = range::count,
     .about = Class::Work, .allowance = Allowance{.relative = 0.005},
     .meaning = "textures and buffers of the technique's own"},
});
// clang-format on

/// A line of the table by its path; one that the table lacks does not compile.
class MetricId {
public:
    consteval MetricId(const char* path) : index_(indexOf(path)) {}
    explicit MetricId(const Metric& line) : index_(static_cast<std::size_t>(&line - table.data())) {}

    [[nodiscard]] constexpr std::size_t index() const { return index_; }

private:
    static constexpr std::size_t indexOf(std::string_view path) {
        for (std::size_t i = 0; i < table.size(); ++i)
            if (table[i].path == path) return i;
        throw "no metric of the table has this path";
    }

    std::size_t index_;
};

/// Lines whose path begins with `group` and a dot.
constexpr std::span<const Metric> linesOf(std::string_view group) {
    const auto isIn = [&](const Metric& m) { return m.path.starts_with(group) && m.path[group.size()] == '.'; };
    std::size_t first = 0;
    while (first < table.size() && !isIn(table[first])) ++first;
    std::size_t end = first;
    while (end < table.size() && isIn(table[end])) ++end;
    return std::span(table).subspan(first, end - first);
}

/// The line with a path, or with a name for bounds; null if there is none.
const Metric* metricAt(std::string_view path);
const Metric* boundedMetric(std::string_view name);

/// The names that a bound can have, in the table's order.
const std::vector<std::string>& boundedMetrics();

/// How much of a change means nothing, in words: "2 pixels + 1 %".
std::string describe(const Allowance& allowance);

} // namespace shadowbench::metrics
