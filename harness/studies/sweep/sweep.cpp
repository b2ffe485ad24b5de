#include "harness/studies/sweep/sweep.h"

#include "base/progress_line.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell.h"
#include "harness/metrics/table.h"
#include "harness/studies/sweep/axis.h"
#include "harness/studies/sweep/variants.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache), curves_(variants_.size()) {
        for (const double value : values_) {
            if (axis_.whole && value != std::floor(value))
                throw BadInput(fmt::format("axis {} takes whole numbers; {:g} is none", axis_.id, value));
            requireTakenBySome(value);
        }
    }

    SweepResult all() {
        ProgressLine line(fmt::format("{} over {}", scene_.id, axis_.id), static_cast<int>(values_.size()), options_.quiet);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const auto show = [&](double share, std::string_view what) { line.show(static_cast<int>(i), share, what); };
            step(values_[i], show);
        }
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

    void step(double value, const Progress& progress) {
        Scene scene = scene_;
        if (!axis_.isParameter()) axis_.move(scene, value);
        std::string unsound;
        try {
            requireWellPosed(scene);
        } catch (const BadInput& error) {
            unsound = error.what();
        }
        Stage stage(scene);
        Truths truths(scene, cache_);
        for (std::size_t i = 0; i < variants_.size(); ++i) {
            Variant variant = variants_[i];
            std::string reason = unsound;
            if (axis_.isParameter()) reason = setParameter(variant, value);
            progress(static_cast<double>(i) / static_cast<double>(variants_.size()),
                     fmt::format("{} {}", value, variant.name));
            Record record = blankRecord(scene, variant, options_.seed);
            record.sweep = SweepStep{axis_.id, axis_.unit, variants_[i].name, value, {}};
            score(scene, stage, truths, variant, reason, record);
            curves_[i].push_back(std::move(record));
        }
    }

    /// `excluded`: why there is nothing to score; empty if there is.
    void score(const Scene& scene, Stage& stage, Truths& truths, const Variant& variant, const std::string& excluded,
               Record& record) {
        if (const auto reason = excluded.empty() ? notApplicable(scene, variant) : std::optional(excluded)) {
            record.status = Status::NotApplicable;
            record.reason = *reason;
            return;
        }
        try {
            record.cell = cellId(truths, scene, variant, options_.seed);
            CellImages images;
            const MeasureOptions measure{.seed = options_.seed, .time = false, .images = {}};
            runCell(scene, stage, truths, variant, measure, record, images);
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
    std::vector<std::vector<Record>> curves_;
    SweepResult result_;
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
