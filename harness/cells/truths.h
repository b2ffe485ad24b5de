// The references of one scene, computed or fetched once each.
#pragma once

#include "groundtruth/oracle.h"
#include "groundtruth/store/cache.h"
#include "scene/scene.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench {

/// Exact truth of the light's centre, or soft truth of the whole light: the visible fraction of an area light, the share of
/// an environment's irradiance that arrives. PixelArea is the exact truth of the light's centre over each pixel's square.
enum class Truth { Hard, Soft, PixelArea };
std::string_view name(Truth truth);      // "hard", "soft", "pixel-area"
Truth truthNamed(std::string_view name); // throws BadInput naming all

/// Whether a scene's light has that truth: an environment, all around, has no hard one and no pixel areas, and only it and
/// area lights have a soft one.
bool hasTruth(const Light& light, Truth truth);
std::vector<Truth> truthsOf(const Light& light); // in the order above

/// The request for one frame's truth; moving frames of an area light take fewer samples. Throws BadInput for a truth that
/// the scene's light does not have.
groundtruth::Request referenceRequest(const Scene& scene, Truth truth, int frame);

/// Frames that are scored: the last still one and the moving ones.
std::vector<int> scoredFrames(const Scene& scene);

class Truths {
public:
    Truths(const Scene& scene, const groundtruth::Cache& cache) : scene_(scene), cache_(cache) {}

    /// As the functions above, of this object's scene.
    [[nodiscard]] groundtruth::Request request(Truth truth, int frame) const {
        return referenceRequest(scene_, truth, frame);
    }
    [[nodiscard]] std::vector<int> scoredFrames() const { return shadowbench::scoredFrames(scene_); }

    /// groundtruth::key of that request, computed once: it hashes every mesh and asks the tools for their versions.
    [[nodiscard]] const std::string& key(Truth truth, int frame) const { return keyOf(truth, frame).text; }

    /// The reference, valid as long as this object.
    const groundtruth::Reference& at(Truth truth, int frame, const Progress& progress = {});

private:
    [[nodiscard]] const groundtruth::ReferenceKey& keyOf(Truth truth, int frame) const;

    const Scene& scene_;
    const groundtruth::Cache& cache_;
    std::map<std::pair<Truth, int>, groundtruth::Reference> known_;
    mutable std::map<std::pair<Truth, int>, groundtruth::ReferenceKey> keys_;
};

} // namespace shadowbench
