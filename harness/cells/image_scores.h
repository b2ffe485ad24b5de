// The scores of images of visibility, whoever drew them: this program's techniques or another renderer.
#pragma once

#include "base/hash.h"
#include "harness/cells/scene_frames.h"
#include "harness/cells/truths.h"
#include "harness/records/record.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace shadowbench {

/// By what images are scored (docs/metrics.md, "Which truth a cell is scored against").
struct ScoringRule {
    Truth truth = Truth::Hard; // what the images claim to show, frame after frame; never PixelArea
    bool graded = false;       // hard shadows with smoothed edges, or with a history: also as graded visibility
    bool pixelAreas = false;   // and against the mean over each pixel's square
    bool remembers = false;    // the renderer keeps a history
    bool stillFrames = false;  // that begins empty, and all still frames are added, not the last one alone
};

/// Whether images that claim to show `truth` are scored against pixel areas, too: hard ones are, under an area light only by
/// what changes from frame to frame.
bool usesPixelAreas(const Scene& scene, Truth truth);

/// The error of an image in one number: wrong labels by the hard truth, rms by others. Nothing where no pixel is scored.
std::optional<double> errorBy(Truth truth, const metrics::ScoredFrame& frame);

/// What visibility is graded against, whatever the images claim to show.
Truth gradedTruth(const Scene& scene);

/// The receivers of the frame that is shown, by a truth; valid as long as the scores.
using Receivers = std::function<const metrics::Mask&(Truth)>;

/// Scores one image after the other. Each is of the frame that is shown: the still ones up to the scored one, of which all
/// but the last are for renderers with a history, then the moving ones.
class ImageScores {
public:
    /// `frames` must outlive the object. `variant` is for messages.
    ImageScores(SceneFrames& frames, const ScoringRule& rule, Receivers receivers, std::string variant);
    ~ImageScores();
    ImageScores(const ImageScores&) = delete;
    ImageScores& operator=(const ImageScores&) = delete;

    /// Fills in references and accuracy with the last still frame. Throws InternalError for a receiver without an answer in
    /// [0, 1] and when more than 0.1 % of the primary hits disagree with the truth's: an error of the set-up, not a score.
    void add(int frame, const Image<float>& v, Record& record);

    /// Fills in stability and the hashes of the images and of their truths, once all are added.
    void finish(Record& record) const;

    /// What `flicker` is the mean of, of the scored frame (nothing) and each moving one; empty where nothing moves.
    [[nodiscard]] std::vector<Image<float>> flickerMaps() const;

private:
    struct Sequences;
    void addTruths(int frame);

    SceneFrames& frames_;
    ScoringRule rule_;
    Receivers receivers_;
    std::string variant_;
    Hasher128 shown_, truths_;
    std::unique_ptr<Sequences> sequences_;
};

} // namespace shadowbench
