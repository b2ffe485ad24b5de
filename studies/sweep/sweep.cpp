#include "studies/sweep/sweep.h"

#include "base/parallel.h"
#include "base/progress_line.h"
#include "base/worker_processes.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell.h"
#include "harness/metrics/table.h"
#include "harness/render/shared_shaders.h"
#include "scene/load/load.h"
#include "studies/sweep/axis.h"
#include "studies/sweep/variants.h"
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <sstream>

namespace shadowbench {
namespace {

using techniques::Variant;

std::vector<Variant> chosenVariants(const SweepOptions& options, const Axis& axis) {
    std::vector<Variant> variants;
    for (const std::string& pattern : options.techniques.empty() ? std::vector<std::string>{"*"} : options.techniques)
        for (Variant& variant : techniques::matchVariants(pattern)) {
            if (variant.isLod() || (axis.isParameter() && !parameterOf(variant, axis.id))) continue;
            if (std::ranges::none_of(variants, [&](const Variant& v) { return v.name == variant.name; }))
                variants.push_back(std::move(variant));
        }
    if (variants.empty())
        throw BadInput(fmt::format(
            "none of the chosen techniques has a parameter \"{}\": choose other techniques, or another axis", axis.id));
    return variants;
}

/// Everything at rest, and only the frames that the scored one needs.
Scene atRest(Scene scene) {
    scene.timeline.moving = 0;
    scene.lightCentre.keys.clear();
    scene.lightDirection.keys.clear();
    return scene;
}

class Sweeper {
public:
    explicit Sweeper(const SweepOptions& options)
        : options_(options), axis_(axisNamed(options.axis)), variants_(chosenVariants(options, axis_)),
          scene_(atRest(loadScene(options.scene, options.profile, metrics::boundedMetrics()))),
          values_(options.values.empty() ? axis_.valuesFor(scene_) : options.values),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache),
          curves_(variants_.size(), std::vector<Record>(values_.size())) {
        for (const double value : values_)
            if (axis_.whole && value != std::floor(value))
                throw BadInput(fmt::format("axis {} takes whole numbers; {:g} is none", axis_.id, value));
        // Not in this process, which forks: drivers of graphics processors do not outlive that.
        checkInOwnProcess([this] {
            const auto context = contextOfRun(cache_.folder(), false);
            for (const double value : values_) requireTakenBySome(value);
        });
    }

    SweepResult all() {
        ProgressLine line(fmt::format("{} over {}", scene_.id, axis_.id), static_cast<int>(values_.size()), options_.quiet);
        int done = 0;
        SharedWork work;
        work.items = values_.size();
        work.work = [this](std::size_t i, const Progress& progress) { return answerOf(i, progress); };
        work.leave = [this] { context_.reset(); };
        work.progress = [&](std::size_t i, double share, std::string_view what) {
            line.show(done, share, what.empty() ? fmt::format("{}", values_[i]) : what);
        };
        work.finished = [&](std::size_t i, const std::string& answer) {
            ++done;
            keep(i, answer);
        };
        work.lost = [&](std::size_t i, const std::string& how) {
            throw InternalError(fmt::format("the process that scored {} at {:g} {}", axis_.id, values_[i], how));
        };
        shareAmongProcesses(availableThreads(), work);
        line.show(static_cast<int>(values_.size()), 0, "");
        for (std::vector<Record>& curve : curves_) {
            const std::optional<double> point = breakPoint(curve);
            for (Record& record : curve) {
                record.sweep->breakPoint = point;
                result_.records.push_back(std::move(record));
            }
        }
        return std::move(result_);
    }

private:
    /// Sets the axis' parameter; why not, if the variant does not take the value. Making the technique tells whether its
    /// parameters go together.
    std::string setParameter(Variant& variant, double value) const {
        try {
            variant = withParameter(variant, axis_.id, fmt::format("{}", value));
            variant.entry->make(variant.parameters);
            return "";
        } catch (const BadInput& error) {
            return error.what();
        }
    }

    void requireTakenBySome(double value) const {
        if (!axis_.isParameter()) return;
        std::string reason;
        for (Variant variant : variants_)
            if ((reason = setParameter(variant, value)).empty()) return;
        throw BadInput(reason);
    }

    /// In a worker: the exit code and the records of value `i`, a line each; instead of these what cannot be scored at all.
    std::string answerOf(std::size_t i, const Progress& progress) {
        if (!context_) context_ = contextOfRun(cache_.folder(), false);
        result_.code = ExitCode::Pass;
        std::string lines;
        try {
            for (const Record& record : scoredAt(values_[i], progress)) lines += toJson(record) + "\n";
        } catch (const Error& error) {
            return fmt::format("{}\nerror {}", static_cast<int>(error.code()), error.what());
        }
        return fmt::format("{}\n{}", static_cast<int>(result_.code), lines);
    }

    void keep(std::size_t i, const std::string& answer) {
        std::istringstream lines(answer);
        std::string line;
        std::getline(lines, line);
        const auto code = static_cast<ExitCode>(std::stoi(line));
        if (result_.code == ExitCode::Pass) result_.code = code;
        for (std::vector<Record>& curve : curves_) {
            std::getline(lines, line);
            if (line.starts_with("error ")) throw Error(code, line.substr(6));
            curve[i] = parseRecord(line);
        }
    }

    /// All variants where the axis has `value`.
    std::vector<Record> scoredAt(double value, const Progress& progress) {
        Scene scene = scene_;
        if (!axis_.isParameter()) axis_.move(scene, value);
        std::string unsound;
        try {
            requireWellPosed(scene);
        } catch (const BadInput& error) {
            unsound = error.what();
        }
        Truths truths(scene, cache_);
        SceneFrames frames(scene, truths);
        std::vector<Record> records;
        for (std::size_t i = 0; i < variants_.size(); ++i) {
            Variant variant = variants_[i];
            std::string reason = unsound;
            if (axis_.isParameter()) reason = setParameter(variant, value);
            progress(static_cast<double>(i) / static_cast<double>(variants_.size()),
                     fmt::format("{} {}", value, variant.name));
            Record record = blankRecord(scene, variant, options_.seed);
            record.sweep = SweepStep{axis_.id, axis_.unit, variants_[i].name, value, {}};
            score(frames, variant, reason, record);
            records.push_back(std::move(record));
        }
        return records;
    }

    /// `excluded`: why there is nothing to score; empty if there is.
    void score(SceneFrames& frames, const Variant& variant, const std::string& excluded, Record& record) {
        const Scene& scene = frames.scene();
        if (const auto reason = excluded.empty() ? notApplicable(scene, variant) : std::optional(excluded)) {
            record.status = Status::NotApplicable;
            record.reason = *reason;
            return;
        }
        try {
            MeasureOptions measure;
            measure.seed = options_.seed;
            record.cell = cellId(frames.truths(), scene, variant, measure);
            CellImages images;
            scoreCell(frames, variant, options_.seed, record, images);
        } catch (const Error& error) {
            Record failed = blankRecord(scene, variant, options_.seed);
            failed.sweep = record.sweep;
            failed.status = Status::Error;
            failed.reason = error.what();
            record = std::move(failed);
            if (result_.code == ExitCode::Pass) result_.code = error.code();
        }
    }

    const SweepOptions& options_;
    const Axis& axis_;
    std::vector<Variant> variants_;
    Scene scene_;
    std::vector<double> values_;
    groundtruth::Cache cache_;
    std::vector<std::vector<Record>> curves_; // of each variant, by value
    SweepResult result_;
    std::unique_ptr<gl::Context> context_; // of a worker
};

} // namespace

SweepResult sweep(const SweepOptions& options) { return Sweeper(options).all(); }

std::optional<double> breakPoint(const std::vector<Record>& curve) {
    for (const Record& record : curve) {
        if (record.status != Status::Scored || record.tolerances.empty()) continue;
        const auto& [metric, most] = *record.tolerances.begin();
        const std::optional<double> error = metrics::bounded(record.values, metric);
        if (error && *error > most) return record.sweep->value;
    }
    return std::nullopt;
}

} // namespace shadowbench
