// The references of one scene, computed or fetched once each.
#pragma once

#include "groundtruth/cache.h"
#include "groundtruth/reference.h"
#include "harness/scene/scene.h"

#include <map>
#include <utility>

namespace shadowbench {

/// Exact truth of the light's centre, or soft truth of the whole area light.
enum class Truth { Hard, Soft };

class Truths {
public:
    Truths(const Scene& scene, const groundtruth::Cache& cache) : scene_(scene), cache_(cache) {}

    /// The request for one frame's truth; moving frames of an area light take fewer samples.
    [[nodiscard]] groundtruth::Request request(Truth truth, int frame) const;

    /// The reference, valid as long as this object.
    const groundtruth::Reference& at(Truth truth, int frame, const Progress& progress = {});

    /// Frames that are scored: the last still one and the moving ones.
    [[nodiscard]] std::vector<int> scoredFrames() const;

private:
    const Scene& scene_;
    const groundtruth::Cache& cache_;
    std::map<std::pair<Truth, int>, groundtruth::Reference> known_;
};

} // namespace shadowbench
