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

using groundtruth::hasTruth;
using groundtruth::Truth;
using groundtruth::truthNamed;

/// The truths that a light has of those by which cells are scored: Hard, Soft and PixelArea. A moving frame's truths are of
/// the light's place in it.
std::vector<Truth> truthsOf(const Light& light);

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

    /// Whether the cache holds the reference, which may be damaged.
    [[nodiscard]] bool isKept(Truth truth, int frame) const;

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
