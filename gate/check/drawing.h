// One frame that a renderer drew of a scene whose shadows are known, and what is wrong with it in terms of what an adapter
// does.
#pragma once

#include "base/temporary_folder.h"
#include "gate/check/mistakes.h"
#include "groundtruth/contract/reference.h"
#include "harness/foreign/recognition.h"
#include "harness/foreign/renderer.h"
#include "harness/foreign/visibility.h"
#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::gate {

/// The truth that images of that definition are compared with.
groundtruth::Truth truthOf(foreign::Definition definition);

/// "2.5 %"
std::string percent(double share);

/// What is true of a scene's frames, and what mistakes would draw: computed when first asked for.
class KnownScene {
public:
    explicit KnownScene(Scene scene);

    /// In place of what somebody has changed.
    void exportAnew();

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<int>& frames() const { return frames_; }
    [[nodiscard]] std::filesystem::path exported() const { return folder_.path() / "scene"; }

    const groundtruth::Reference& truth(groundtruth::Truth truth, int frame);

    /// Nothing where the mistake changes nothing or leaves nothing to see.
    const std::optional<groundtruth::Reference>& with(const Mistake& mistake, int frame);

    /// Mistakes that no image could be compared with: their sentences, each with the reason.
    [[nodiscard]] const std::map<std::string, std::string>& unknown() const { return unknown_; }

private:
    std::optional<groundtruth::Reference> computed(const Mistake& mistake, int frame);

    Scene scene_;
    std::vector<int> frames_;
    TemporaryFolder folder_;
    std::map<std::pair<groundtruth::Truth, int>, groundtruth::Reference> truths_;
    std::map<std::pair<const Mistake*, int>, std::optional<groundtruth::Reference>> mistaken_;
    std::map<std::string, std::string> unknown_;
};

struct Drawing {
    const foreign::Renderer& renderer;
    KnownScene& known;
    int frame;
    const Image<float>& v;
    const groundtruth::Reference& truth; // of the renderer's definition
    foreign::Pixels scored;

    [[nodiscard]] bool labels() const { return renderer.definition == foreign::Definition::Hard; }
    [[nodiscard]] foreign::Compared compared() const { return {v, truth.visibility, scored, labels()}; }
};

/// What is wrong; the first that explains it. Empty: nothing.
std::string wrongWith(const Drawing& drawing);

} // namespace shadowbench::gate
