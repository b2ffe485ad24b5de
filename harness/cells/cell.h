// One cell: a technique variant on a scene. Renders its frames, scores them against the truth, measures their cost.
#pragma once

#include "base/error.h"
#include "harness/cells/measure_options.h"
#include "harness/cells/scene_frames.h"
#include "harness/cells/truths.h"
#include "harness/records/record.h"
#include "techniques/contract/entry.h"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

/// What a cell leaves beside its record: its images of visibility by frame, from the scored one on, and what is true of
/// that.
struct CellImages {
    std::map<int, Image<float>> frames;
    const groundtruth::Reference* reference = nullptr;
    bool wantsFlicker = false;
    std::vector<Image<float>> flicker = {}; // where wanted: of each of them since the one before; of the first 0

    [[nodiscard]] const Image<float>& visibility() const { return frames.begin()->second; }
};

/// What is known of images of visibility, whoever draws them, before they are scored.
Record blankRecord(const Scene& scene, std::uint32_t seed);

/// What is known of a cell before it runs: everything but scores and costs. Needs a GL context.
Record blankRecord(const Scene& scene, const techniques::Variant& variant, std::uint32_t seed);

/// The truth that a technique's answer is measured by frame after frame.
Truth mainTruth(const Scene& scene, const techniques::Variant& variant);

/// The truth that the changes from frame to frame are compared with.
Truth sequenceTruth(const Scene& scene, const techniques::Variant& variant);

/// Whether a cell is scored against the truth of pixel areas: hard and filtered answers are, under an area light only by
/// what changes from frame to frame.
bool usesPixelAreas(const Scene& scene, const techniques::Variant& variant);

/// Hash of everything a cell's scores depend on: truths (hence the scene), variant, frames, seeds, views, schema.
std::string cellId(const Truths& truths, const Scene& scene, const techniques::Variant& variant,
                   const MeasureOptions& options);

/// Why the variant does not apply to the scene; nothing if it does.
std::optional<std::string> notApplicable(const Scene& scene, const techniques::Variant& variant);

/// How long a cell may take to be drawn and scored, its truths being there: of a technique folder, whose shaders may hang.
/// 0: as long as it does.
std::chrono::seconds longestFor(const Scene& scene, const techniques::Variant& variant);

/// What a cell ends with whose process was lost (SharedWork::lost), with what to do where that is known.
InternalError lostCell(const std::string& how);

/// Whether a cell's work and memory are measured, too. It takes three more drawings, two of them from nothing kept.
enum class CellWork { Counted, LeftOut };

/// Fills in status, references, accuracy, stability and work of a blank record. Throws what rendering or the truth throws,
/// and InternalError when more than 0.1 % of the primary hits disagree with the truth's: that is an error of the set-up, not
/// a score. All but the work is the same without it.
void scoreCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record,
               CellImages& images, CellWork work = CellWork::Counted);

/// Renders the last still frame from an empty history. Returns the number of frames that the technique has rendered.
/// `casters`: what casts in place of the scene's own, which are at rest until that frame.
int renderScored(SceneFrames& frames, const techniques::Entry& entry, techniques::Technique& technique, std::uint32_t seed,
                 const std::vector<Batch>* casters = nullptr);

/// The error of a variant on the scored frame by `truth` (`errorBy`), drawn from an empty history.
std::optional<double> scoredError(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Truth truth);

/// Splits the error of the scored frame, of which `v` is the image that `seed` drew, over `seeds` ≥ 2 of them from `seed` on
/// into what all have in common and noise; of a variant that draws the same with all it says nothing.
void splitErrorOverSeeds(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, int seeds,
                         const Image<float>& v, Record& record);

/// Fills in the time of the frame that is scored, with a history as full as it is there. Beside a program that keeps the
/// processor busy it says little.
void timeCell(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record);

} // namespace shadowbench
