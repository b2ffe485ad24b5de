// Another renderer's images, scored as this program's techniques are.
#pragma once

#include "harness/cells/cell.h"
#include "harness/cells/scene_frames.h"
#include "harness/foreign/foreign_row.h"
#include "harness/records/record.h"

#include <string>
#include <utility>
#include <vector>

namespace shadowbench::foreign {

/// Throws BadInput for an id that is no id, a meaning that the scene's light does not have, and frames that are not the
/// scored one or all from it on. Reads no file.
void requireScorable(const Scene& scene, const ForeignRow& row);

/// The truths that its scores need, frame by frame.
std::vector<std::pair<Truth, int>> truthsOf(const Scene& scene, const ForeignRow& row);

/// Hash of everything but the files that the row's scores depend on.
std::string cellId(const Truths& truths, const Scene& scene, const ForeignRow& row);

/// What is known of the row's record before its images are there: all but scores, with status `Scored`. An error's record is
/// this one with its status and reason.
Record blankRecord(const Truths& truths, const Scene& scene, const ForeignRow& row);

/// Scores the row's images. `warnings` gets a line each of what looks odd and was scored all the same. Throws BadInput, with
/// the file's name, for images that cannot be read, have another size, or hold no visibility (not finite, outside [0, 1],
/// unequal channels, transparent), and for those that look black, inverted, flipped, shifted, of another frame or wrongly
/// encoded; what throws for want of a truth, throws. Needs a GL context: the scene's own hits say which pixels are scored.
/// `shown`, if any, gets visibility by frame, the scored frame's truth and, where wanted, flicker, for pictures.
Record scoreImages(SceneFrames& frames, const ForeignRow& row, std::vector<std::string>& warnings,
                   CellImages* shown = nullptr);

} // namespace shadowbench::foreign
