#include "gate/truth_sample.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/progress_line.h"
#include "groundtruth/oracle.h"
#include "groundtruth/store/golden.h"
#include "harness/cells/truths.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include <algorithm>
#include <fmt/format.h>
#include <list>
#include <optional>

namespace shadowbench::gate {
namespace {

using groundtruth::Reference;

constexpr int sampleSize = 2;

/// Exact truths, and what POV-Ray samples at a gate's size, take seconds. A large scene of a user's can take an hour, which
/// no gate should take twice.
constexpr double mostSeconds = 60;

/// A truth that a gate may have scored against.
struct Candidate {
    std::string draw; // those with the least are looked at
    const Scene* scene;
    Truth truth;
    int frame;

    [[nodiscard]] std::string name() const {
        return fmt::format("the {} truth of {} frame {}", groundtruth::name(truth), scene->id, frame);
    }
};

std::vector<Candidate> candidatesOf(const std::list<Scene>& scenes, const std::string& commit) {
    std::vector<Candidate> candidates;
    for (const Scene& scene : scenes)
        for (const auto& [truth, frame] : askedTruths(scene)) {
            Candidate& one = candidates.emplace_back(Candidate{"", &scene, truth, frame});
            one.draw = hash128(commit + one.name()).text();
        }
    std::ranges::sort(candidates, {}, &Candidate::draw);
    return candidates;
}

/// What the cache holds; nothing, too, where a tool is missing that the key names: then nobody can have used it.
std::optional<Reference> kept(const groundtruth::Request& request, const groundtruth::Cache& cache) {
    try {
        const groundtruth::ReferenceKey key = groundtruth::referenceKey(request);
        return cache.find(key.text, key.sources);
    } catch (const Inconclusive&) {
        return {};
    }
}

/// How the request's truth, computed without the cache, contradicts `before`; "" if it is the same.
std::string contradiction(const groundtruth::Request& request, const Reference& before, const Progress& progress) {
    try {
        const Reference now = groundtruth::compute(request, progress);
        if (contentHashes(now) == contentHashes(before)) return "";
        return fmt::format("is not the one that was kept ({})", describe(difference(before, now)));
    } catch (const Error& error) {
        return fmt::format("cannot be computed any more ({})", error.what());
    }
}

} // namespace

std::vector<std::string> contradictedTruths(const std::vector<JudgedScene>& scenes, Profile profile,
                                            const std::filesystem::path& cache, const std::string& commit, bool quiet) {
    std::list<Scene> loaded; // which candidates refer to
    for (const JudgedScene& scene : scenes) loaded.push_back(loadScene(scene.argument, profile, metrics::boundedMetrics()));
    const groundtruth::Cache references(cache);
    ProgressLine line("gate: kept truths computed anew", sampleSize, quiet);
    std::vector<std::string> sentences;
    int looked = 0;
    for (const Candidate& one : candidatesOf(loaded, commit)) {
        if (looked == sampleSize) break;
        const groundtruth::Request request = referenceRequest(*one.scene, one.truth, one.frame);
        const std::optional<Reference> before = kept(request, references);
        if (!before || before->provenance.seconds > mostSeconds) continue;
        const std::string name = one.name(), what = contradiction(request, *before, [&](double share, std::string_view) {
                                                 line.show(looked, share, name);
                                             });
        line.show(++looked, 0, name);
        if (!what.empty())
            sentences.push_back(fmt::format(
                "{}, computed anew, {}: nothing that was scored against it counts. Remove {}, which holds such scores, and "
                "the kept truths by `shadowbench cache prune --all --cache {}`, and run the gate again",
                name, what, (cache / "gate").string(), cache.string()));
    }
    return sentences;
}

} // namespace shadowbench::gate
