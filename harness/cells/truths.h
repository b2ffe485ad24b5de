// The references of one scene, computed or fetched once each.
#pragma once

#include "groundtruth/oracle.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/golden_contents.h"
#include "scene/scene.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench {

/// Exact truth of the light's centre, or soft truth of the whole light: the visible fraction of an area light, the share of
/// an environment's irradiance that arrives. PixelArea is the exact truth of the light's centre over each pixel's square.
/// Area is the exact visible fraction of an area light at every pixel: what its soft truth, which POV-Ray samples, is held
/// to. Irradiance and SolidAngle are exact shares of a rectangle or disk by other definitions of soft visibility, for images
/// that other renderers made (docs/ground-truth.md, "Other definitions of soft visibility").
enum class Truth { Hard, Soft, PixelArea, Area, Irradiance, SolidAngle };
std::string_view name(Truth truth);      // "hard", "soft", "pixel-area", "area", "irradiance", "solid-angle"
Truth truthNamed(std::string_view name); // throws BadInput naming all

/// Whether a scene's light has that truth: an environment, all around, has no hard one and no pixel areas, and only it and
/// area lights have a soft one. A line has no solid angle, and no side that emits.
bool hasTruth(const Light& light, Truth truth);
std::vector<Truth> truthsOf(const Light& light); // of those before Area, by which cells are scored

/// The request for one frame's truth; moving frames of an area light take fewer samples. Throws BadInput for a truth that
/// the scene's light does not have.
groundtruth::Request referenceRequest(const Scene& scene, Truth truth, int frame);

/// All that a run of the scene asks for: truthsOf its light for each scored frame, and Area for the last still one.
std::vector<std::pair<Truth, int>> askedTruths(const Scene& scene);

class Truths {
public:
    /// What `golden` names must have the content that it says.
    Truths(const Scene& scene, const groundtruth::Cache& cache, const GoldenContents& golden = committedContents())
        : scene_(scene), cache_(cache), golden_(golden) {}

    /// As the functions above, of this object's scene.
    [[nodiscard]] groundtruth::Request request(Truth truth, int frame) const {
        return referenceRequest(scene_, truth, frame);
    }
    [[nodiscard]] std::vector<int> scoredFrames() const { return shadowbench::scoredFrames(scene_); }

    /// groundtruth::key of that request, computed once: it hashes every mesh and asks the tools for their versions.
    [[nodiscard]] const std::string& key(Truth truth, int frame) const { return keyOf(truth, frame).text; }

    /// groundtruth::sourcesOf that request.
    [[nodiscard]] const std::string& sources(Truth truth, int frame) const { return keyOf(truth, frame).sources; }

    /// The reference, valid as long as this object. Throws what computing throws, and Inconclusive for one that has the key
    /// of a golden reference and another content, and for the soft truth of an area light, in the last still frame, whose
    /// rms error against Area is not what its certificate says.
    const groundtruth::Reference& at(Truth truth, int frame, const Progress& progress = {}) {
        return known(truth, frame, progress).reference;
    }

    /// groundtruth::contentOf of that reference.
    const std::string& content(Truth truth, int frame) { return known(truth, frame, {}).content; }

private:
    struct Known {
        groundtruth::Reference reference;
        std::string content;
    };
    [[nodiscard]] const groundtruth::ReferenceKey& keyOf(Truth truth, int frame) const;
    const Known& known(Truth truth, int frame, const Progress& progress);
    void requireNearArea(const groundtruth::Reference& soft, int frame, const Progress& progress);

    const Scene& scene_;
    const groundtruth::Cache& cache_;
    const GoldenContents& golden_;
    std::map<std::pair<Truth, int>, Known> known_;
    mutable std::map<std::pair<Truth, int>, groundtruth::ReferenceKey> keys_;
};

} // namespace shadowbench
