#include "studies/recommend/caster_levels.h"

#include "base/error.h"
#include "base/progress.h"
#include "studies/recommend/hard_choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::recommend {
namespace {

using ErrorsOfLevels = std::function<Errors(const Levels&)>;

/// Shares of the progress at which the receivers are found, and the search starts and ends.
constexpr double receiversUntil = 0.1, searchFrom = 0.3, searchUntil = 0.7;

Errors toleranceOf(const Scene& scene, const std::vector<std::string>& words) {
    Errors tolerance = words.empty() ? ownTolerance(scene) : parseTolerance(words, scene.light);
    if (tolerance.empty())
        throw BadInput(
            fmt::format("scene {} states no tolerance for shadows of its light: give one with --tolerance", scene.id));
    return tolerance;
}

int frameOf(const Scene& scene, std::optional<int> wanted) {
    const int frame = wanted.value_or(scene.timeline.still - 1);
    if (frame < 0 || frame >= scene.timeline.frames())
        throw BadInput(fmt::format("scene {} has frames 0 to {}, not {}", scene.id, scene.timeline.frames() - 1, frame));
    return frame;
}

/// Errors of whole shadows against that of the finest levels.
class WholeShadows {
public:
    WholeShadows(const Casters& casters, const Receivers& receivers, ShadowOracle oracle)
        : receivers_(receivers), oracle_(std::move(oracle)), exact_(oracle_.shadow(casters.cast(casters.finest()))) {}

    [[nodiscard]] Errors of(const Snapshot& casters) const {
        const Shadow shadow = oracle_.shadow(casters);
        return casters.light.isArea() ? softErrors(shadow, exact_, receivers_) : hardErrors(shadow, exact_);
    }

private:
    const Receivers& receivers_;
    ShadowOracle oracle_;
    Shadow exact_;
};

/// The next level that casts fewer triangles.
std::optional<std::size_t> coarserThan(const CasterGroup& group, std::size_t level) {
    for (std::size_t next = level + 1; next < group.levels.size(); ++next)
        if (group.triangles(next) < group.triangles(level)) return next;
    return std::nullopt;
}

GroupLevel describe(const CasterGroup& group, std::size_t level) {
    GroupLevel result{group.object, group.from, group.until, group.placements.size(), {}, level, {}};
    for (const auto& mesh : group.levels) result.chain.push_back(mesh->triangles.size());
    return result;
}

Progress part(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [&progress, from, to](double done, std::string_view what) { progress(from + (to - from) * done, what); };
}

class Recommender {
public:
    Recommender(const Scene& scene, const CasterOptions& options, const Progress& progress)
        : scene_(scene), frame_(frameOf(scene, options.frame)), tolerance_(toleranceOf(scene, options.tolerance)),
          casters_(withChains(scene, options.chains), frame_, options.bands.empty() ? ownBands(scene) : options.bands),
          drawn_(snapshot(scene, frame_)),
          receivers_(receivers(drawn_, scene.size, casters_, part(progress, 0, receiversUntil))),
          samples_(options.lightSamples), progress_(progress) {}

    CasterRecommendation recommend() {
        CasterRecommendation result = blank();
        const bool area = scene_.light.isArea();
        const ShadowOracle oracle = area ? areaOracle(receivers_) : rayOracle(receivers_);
        show(receiversUntil, "shadow of the finest levels");
        const WholeShadows whole(casters_, receivers_, oracle);
        result.oracle = oracle.name;
        show(0.5 * (receiversUntil + searchFrom), "shadow of the drawn levels");
        result.drawnErrors = whole.of(drawn_);
        if (area) {
            search(remembered([&](const Levels& levels) { return whole.of(casters_.cast(levels)); }), result);
        } else {
            const HardChoices choices(casters_, receivers_, oracle, part(progress_, searchFrom, searchUntil));
            search([&](const Levels& levels) { return choices.of(levels); }, result);
        }
        verify(area ? sampledOracle(receivers_, samples_) : polygonOracle(receivers_), result);
        return result;
    }

private:
    void show(double done, std::string_view what) const {
        if (progress_) progress_(done, what);
    }

    [[nodiscard]] CasterRecommendation blank() const {
        CasterRecommendation result;
        result.scene = scene_.id;
        result.profile = name(scene_.profile);
        result.frame = frame_;
        result.size = scene_.size;
        result.tolerance = tolerance_;
        result.receiverPixels = receivers_.pixels;
        result.allReceiverPixels = receivers_.all;
        for (const Batch& batch : drawn_.batches)
            for (const Placement& placement : batch.placements)
                if (casters_.hasLevels(placement.id)) result.drawnTriangles += batch.mesh->triangles.size();
        return result;
    }

    /// For errors that take a whole image of visible fractions: each choice is measured once, with progress.
    [[nodiscard]] ErrorsOfLevels remembered(const ErrorsOfLevels& measured) const {
        double possible = 1;
        for (const CasterGroup& group : casters_.groups()) possible *= static_cast<double>(group.levels.size());
        return [=, this, known = std::map<Levels, Errors>()](const Levels& levels) mutable {
            const auto found = known.find(levels);
            if (found != known.end()) return found->second;
            show(searchFrom + (searchUntil - searchFrom) * static_cast<double>(known.size()) / possible,
                 fmt::format("casters at levels {}", fmt::join(levels, " ")));
            return known.emplace(levels, measured(levels)).first->second;
        };
    }

    void search(const ErrorsOfLevels& errorsOf, CasterRecommendation& result) {
        const Costs costs = casters_.costs();
        const auto choice =
            cheapestAdequate(costs, [&](const Levels& levels) { return within(errorsOf(levels), tolerance_); });
        if (!choice) throw InternalError("the finest levels' own shadow was found to differ from itself; report this scene");

        levels_ = choice->levels;
        result.errors = errorsOf(levels_);
        result.tried = choice->tried;
        result.possible = choice->possible;
        result.triangles = totalCost(costs, levels_);
        result.finestTriangles = totalCost(costs, casters_.finest());
        for (std::size_t group = 0; group < levels_.size(); ++group) {
            GroupLevel described = recommend::describe(casters_.groups()[group], levels_[group]);
            if (const auto coarser = coarserThan(casters_.groups()[group], levels_[group]))
                described.coarser = CoarserLevel{*coarser, errorsOf(with(group, *coarser)), {}};
            result.groups.push_back(std::move(described));
        }
    }

    /// The recommended levels but for one group's.
    [[nodiscard]] Levels with(std::size_t group, std::size_t level) const {
        Levels levels = levels_;
        levels[group] = level;
        return levels;
    }

    void verify(const ShadowOracle& oracle, CasterRecommendation& result) const {
        const auto step = [&](std::size_t done, std::string_view what) {
            show(searchUntil + (1 - searchUntil) * static_cast<double>(done) / static_cast<double>(levels_.size() + 2),
                 what);
        };
        step(0, "verification: finest levels");
        const WholeShadows whole(casters_, receivers_, oracle);
        step(1, "verification: recommended levels");
        result.verifier = oracle.name;
        result.verifiedErrors = whole.of(casters_.cast(levels_));
        result.verified = within(result.verifiedErrors, tolerance_);
        for (std::size_t group = 0; group < levels_.size(); ++group) {
            std::optional<CoarserLevel>& coarser = result.groups[group].coarser;
            if (!coarser) continue;
            step(group + 2, "verification: one level coarser");
            coarser->verified = whole.of(casters_.cast(with(group, coarser->level)));
            result.verified = result.verified && !within(coarser->verified, tolerance_);
        }
    }

    const Scene& scene_;
    int frame_;
    Errors tolerance_;
    Casters casters_;
    Snapshot drawn_;
    Receivers receivers_;
    int samples_;
    const Progress& progress_;
    Levels levels_; // recommended
};

} // namespace

CasterRecommendation recommendCasters(const Scene& scene, const CasterOptions& options, const Progress& progress) {
    if (scene.light.isEnvironment())
        throw BadInput(
            fmt::format("levels for shadow casters are chosen by the shadow of one light, and that of scene {} is an "
                        "environment; choose another scene or question",
                        scene.id));
    return Recommender(scene, options, progress).recommend();
}

} // namespace shadowbench::recommend
