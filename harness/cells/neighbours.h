// Whether a row's error is an accident of one image: the same row with another map, another image size, from other views.
#pragma once

#include "harness/cells/changed_scene.h"
#include "harness/records/record.h"
#include "techniques/contract/entry.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace shadowbench {

/// The variant with a map of `neighbourOf` its size; nothing for a technique without a map, or where it may be no larger.
std::optional<techniques::Variant> withNeighbourMap(const techniques::Variant& variant);

/// The factor by which two errors by `truth` differ, at least 1. What is below a thousandth of the labels, or 0.005 of full
/// light, counts as that: so little rests on single pixels.
double stepBetween(Truth truth, double error, double neighbour);

/// Fills in `sanity.map_step` of a record that scoreCell filled in with that seed, if the variant has a neighbour.
void scoreNeighbourMap(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record);

/// Fills in `sanity.image_step` of such a record. `larger` are the frames of the scene's neighbour.
void scoreNeighbourImage(SceneFrames& larger, const techniques::Variant& variant, std::uint32_t seed, Record& record);

/// Fills in the error from each view, the scene's own first, their mean and the worst, of a record that scoreCell filled in
/// with that seed; nothing of a variant with a history, whose still frames are a sequence.
void scoreViews(const Scene& scene, const std::vector<std::unique_ptr<ChangedScene>>& others,
                const techniques::Variant& variant, std::uint32_t seed, Record& record);

} // namespace shadowbench
