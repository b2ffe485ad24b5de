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
#include "techniques/catalog.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <utility>

namespace shadowbench {
namespace {

using techniques::Variant;

std::set<std::string> parameterNames(const Axis& axis) {
    std::set<std::string> names;
    for (const AxisParameter& parameter : axis.parameters) names.insert(parameter.name);
    return names;
}

/// By their ids, unless they are many.
std::string othersThatHave(const Axis& axis) {
    std::vector<std::string> ids;
    for (const techniques::Entry& entry : techniques::catalog())
        if (axis.parameterOf(techniques::parseVariant(entry.id))) ids.push_back(entry.id);
    return ids.size() <= 8 ? fmt::format("{}", fmt::join(ids, ", ")) : "other techniques";
}

std::vector<Variant> chosenVariants(const SweepOptions& options, const Axis& axis) {
    std::vector<Variant> variants;
    for (const std::string& pattern : options.techniques.empty() ? std::vector<std::string>{"*"} : options.techniques)
        for (Variant& variant : techniques::matchVariants(pattern)) {
            if (variant.isLod() || (axis.isParameter() && !axis.parameterOf(variant))) continue;
            if (std::ranges::none_of(variants, [&](const Variant& v) { return v.name == variant.name; }))
                variants.push_back(std::move(variant));
        }
    if (variants.empty())
        throw BadInput(fmt::format("none of the chosen techniques has a parameter \"{}\": choose {}, or another axis",
                                   fmt::join(parameterNames(axis), "\" or \""), othersThatHave(axis)));
    return variants;
}

/// Everything at rest, and only the frames that the scored one needs.
Scene atRest(Scene scene) {
    scene.timeline.moving = 0;
    scene.lightCentre.keys.clear();
    scene.lightDirection.keys.clear();
    return scene;
}

/// What a worker scores in one go.
struct Part {
    std::size_t value;
    std::vector<std::size_t> variants = {};
};

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
        std::vector<Part> together, alone;
        for (std::size_t value = 0; value < values_.size(); ++value) {
            together.push_back({value});
            for (std::size_t i = 0; i < variants_.size(); ++i)
                (mayHang(variants_[i]) ? alone.emplace_back(Part{value}) : together.back()).variants.push_back(i);
        }
        ProgressLine line(fmt::format("{} over {}", scene_.id, axis_.id), static_cast<int>(together.size() + alone.size()),
                          options_.quiet);
        score(together, line, [&](const Part& part, const std::string& how) {
            throw InternalError(fmt::format("the process that scored {} at {:g} {}", axis_.id, values_[part.value], how));
        });
        std::vector<std::pair<Part, std::string>> lost; // their records need a context, before which nothing forks
        score(alone, line, [&](const Part& part, const std::string& how) { lost.emplace_back(part, how); });
        for (const auto& [part, how] : lost) keepLost(part, how);
        line.show(done_, 0, "");
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
    /// A technique folder's: each of its cells is drawn in a process that is ended after its limit, once the truths are
    /// there.
    [[nodiscard]] bool mayHang(const Variant& variant) const { return longestFor(scene_, variant).count() > 0; }

    void score(const std::vector<Part>& parts, ProgressLine& line,
               const std::function<void(const Part&, const std::string& how)>& lost) {
        SharedWork work;
        work.items = parts.size();
        work.work = [&](std::size_t i, const Progress& progress) { return answerOf(parts[i], progress); };
        work.leave = [this] { context_.reset(); };
        work.progress = [&](std::size_t i, double share, std::string_view what) {
            line.show(done_, share, what.empty() ? fmt::format("{}", values_[parts[i].value]) : what);
        };
        work.finished = [&](std::size_t i, const std::string& answer) {
            ++done_;
            keep(parts[i], answer);
        };
        work.lost = [&](std::size_t i, const std::string& how) {
            ++done_;
            lost(parts[i], how);
        };
        work.limit = [&](std::size_t i) {
            const auto hanging =
                std::ranges::find_if(parts[i].variants, [&](std::size_t v) { return mayHang(variants_[v]); });
            if (hanging == parts[i].variants.end()) return std::chrono::seconds(0);
            return longestFor(sceneAt(parts[i].value), variants_[*hanging]);
        };
        shareAmongProcesses(availableThreads(), work);
    }

    [[nodiscard]] Scene sceneAt(std::size_t value) const {
        Scene scene = scene_;
        if (!axis_.isParameter()) axis_.move(scene, values_[value]);
        return scene;
    }

    /// Sets the axis' parameter; why not, if the variant does not take the value. Making the technique tells whether its
    /// parameters go together.
    std::string setParameter(Variant& variant, double value) const {
        try {
            variant = axis_.at(variant, value);
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

    /// In a worker: the exit code and the records of the part, a line each; instead of these what cannot be scored at all.
    std::string answerOf(const Part& part, const Progress& progress) {
        if (!context_) context_ = contextOfRun(cache_.folder(), false);
        result_.code = ExitCode::Pass;
        std::string lines;
        try {
            for (const Record& record : scoredIn(part, progress)) lines += toJson(record) + "\n";
        } catch (const Error& error) {
            return fmt::format("{}\nerror {}", static_cast<int>(error.code()), error.what());
        }
        return fmt::format("{}\n{}", static_cast<int>(result_.code), lines);
    }

    void keep(const Part& part, const std::string& answer) {
        std::istringstream lines(answer);
        std::string line;
        std::getline(lines, line);
        const auto code = static_cast<ExitCode>(std::stoi(line));
        if (result_.code == ExitCode::Pass) result_.code = code;
        while (std::getline(lines, line)) {
            if (line.starts_with("error ")) throw Error(code, line.substr(6));
            Record record = parseRecord(line);
            const auto curve = std::ranges::find(variants_, record.sweep->curve, &Variant::name) - variants_.begin();
            curves_[static_cast<std::size_t>(curve)][part.value] = std::move(record);
        }
    }

    /// A variant alone.
    void keepLost(const Part& part, const std::string& how) {
        if (!context_) context_ = contextOfRun(cache_.folder(), false);
        const Variant& curve = variants_[part.variants.front()];
        const double value = values_[part.value];
        const Variant variant = axis_.isParameter() ? axis_.at(curve, value) : curve;
        const InternalError error = lostCell(how);
        Record& record = curves_[part.variants.front()][part.value] =
            blankRecord(sceneAt(part.value), variant, options_.seed);
        record.sweep = SweepStep{axis_.id, axis_.unit, curve.name, value, {}};
        record.status = Status::Error;
        record.reason = error.what();
        if (result_.code == ExitCode::Pass) result_.code = error.code();
    }

    /// What the cells that follow alone are scored against, so that it takes none of their time.
    void computeTruthsOfFolders(const Scene& scene, Truths& truths, const Progress& progress) const {
        for (const Variant& variant : variants_) {
            if (!mayHang(variant) || notApplicable(scene, variant)) continue;
            for (const int frame : truths.scoredFrames()) {
                truths.at(mainTruth(scene, variant), frame, progress);
                if (usesPixelAreas(scene, variant)) truths.at(Truth::PixelArea, frame, progress);
            }
        }
    }

    /// Where the axis has the part's value.
    std::vector<Record> scoredIn(const Part& part, const Progress& progress) {
        const double value = values_[part.value];
        const Scene scene = sceneAt(part.value);
        std::string unsound;
        try {
            requireWellPosed(scene);
        } catch (const BadInput& error) {
            unsound = error.what();
        }
        Truths truths(scene, cache_);
        if (unsound.empty()) computeTruthsOfFolders(scene, truths, progress);
        SceneFrames frames(scene, truths);
        std::vector<Record> records;
        for (const std::size_t i : part.variants) {
            Variant variant = variants_[i];
            std::string reason = unsound;
            if (axis_.isParameter()) reason = setParameter(variant, value);
            progress(static_cast<double>(records.size()) / static_cast<double>(part.variants.size()),
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
            scoreCell(frames, variant, options_.seed, record, images, options_.work);
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
    int done_ = 0;                         // parts
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
