// One row on one scene: what its error on the scored frame is caused by.
#pragma once

#include "harness/cells/scene_frames.h"
#include "studies/causes/ladder.h"
#include "techniques/contract/entry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::causes {

struct Explanation {
    std::string scene, variant;
    std::string metric;                            // that `error` is: mismatch or mae, as in the row's record
    double error = 0;                              // mean over the receivers
    std::vector<std::pair<Cause, double>> parts;   // of it, the largest first; they add up to it
    std::string change;                            // what to change of the row first
    Split split;                                   // the same by pixel
    const groundtruth::Reference* truth = nullptr; // valid as long as the frames that it was rendered on

    [[nodiscard]] bool isRight() const { return error == 0; }

    /// Lets go of what is needed for a picture alone.
    void releasePixels() {
        split.clear();
        truth = nullptr;
    }
};

/// Renders the scored frame of the row, and again without one cause after the other. `casters`: what casts in place of the
/// scene's own, which is then what removes Cause::Geometry. Needs a GL context; throws what rendering or the truth throws.
Explanation explain(SceneFrames& frames, const techniques::Variant& row, std::uint32_t seed,
                    const std::vector<Batch>* casters = nullptr);

/// The dominant cause of each wrong pixel in its colour, the stronger the more it is wrong; grey where right.
Image<glm::vec3> causePicture(const Explanation& explanation);

} // namespace shadowbench::causes
