#include "harness/gate/compare.h"

#include "harness/scene/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace shadowbench::gate {
namespace {

/// A metric that is watched from commit to commit; smaller is better.
struct Watched {
    std::string_view metric; // path in the record
    Class watchedClass;
    std::optional<double> (*value)(const Record&);
    bool graded = false; // compared with the truth's fractions, so that the truth's σ counts
    double pixels = 0;   // this many pixels of change mean nothing
    double relative = 0; // nor does this share of the base's value
};

/// Rendering is the same to the bit from run to run, so the only allowance that exact truths need is for what an innocent
/// change of rounding may do: a pixel or two whose centre lies on an edge.
constexpr double onePixel = 1, twoPixels = 2;

constexpr std::array watched{
    Watched{"accuracy.mismatch", Class::Labels, [](const Record& r) { return r.accuracy.mismatch; }, false, twoPixels},
    Watched{"accuracy.false_shadow", Class::FalseShadow, [](const Record& r) { return r.accuracy.falseShadow; }, false,
            twoPixels},
    Watched{"accuracy.leak", Class::Leak, [](const Record& r) { return r.accuracy.leak; }, false, twoPixels},
    Watched{"accuracy.mismatch_off_edge", Class::Labels, [](const Record& r) { return r.accuracy.mismatchOffEdge; }, false,
            onePixel},
    Watched{"accuracy.edge_error.mean", Class::Edge,
            [](const Record& r) { return r.accuracy.edgeError ? std::optional(r.accuracy.edgeError->mean) : std::nullopt; },
            false, 0, 0.01},
    Watched{"accuracy.edge_error.signed", Class::Edge,
            [](const Record& r) {
                return r.accuracy.edgeError ? std::optional(std::abs(r.accuracy.edgeError->signedMean)) : std::nullopt;
            },
            false, 0, 0.01},
    Watched{"accuracy.rmse", Class::Penumbra, [](const Record& r) { return r.accuracy.rmse; }, true},
    Watched{"accuracy.penumbra_rmse", Class::Penumbra, [](const Record& r) { return r.accuracy.penumbraRmse; }, true},
    Watched{"accuracy.umbra_leak", Class::Leak, [](const Record& r) { return r.accuracy.umbraLeak; }, true},
    Watched{"accuracy.bad30", Class::Penumbra, [](const Record& r) { return r.accuracy.bad30; }, false, twoPixels},
    Watched{"stability.flicker.mean", Class::Flicker,
            [](const Record& r) { return r.stability.flicker ? std::optional(r.stability.flicker->mean) : std::nullopt; },
            true, 0, 0.01},
    Watched{"stability.flip_rate", Class::Flicker, [](const Record& r) { return r.stability.flipRate; }, false, twoPixels,
            0.01},
    Watched{"stability.convergence", Class::Flicker,
            [](const Record& r) {
                return r.stability.convergence ? std::optional<double>(*r.stability.convergence) : std::nullopt;
            }},
    Watched{"lod.pop", Class::Flicker, [](const Record& r) { return r.lod ? std::optional(r.lod->pop) : std::nullopt; },
            false, 0, 0.01},
    Watched{"lod.walk_pop", Class::Flicker,
            [](const Record& r) { return r.lod ? std::optional(r.lod->walkPop) : std::nullopt; }, false, twoPixels, 0.01},
    Watched{"lod.colour_error", Class::Colour,
            [](const Record& r) { return r.lod ? std::optional(r.lod->colourError) : std::nullopt; }, false, 0, 0.01},
    Watched{"lod.noise", Class::Colour, [](const Record& r) { return r.lod ? r.lod->noise : std::nullopt; }, false, 0, 0.01},
    Watched{"lod.order_error", Class::Colour,
            [](const Record& r) { return r.lod ? std::optional(r.lod->orderError) : std::nullopt; }, false, 0, 0.01},
    Watched{"cost.instructions", Class::Instructions,
            [](const Record& r) {
                return r.cost.instructions ? std::optional(static_cast<double>(*r.cost.instructions)) : std::nullopt;
            },
            false, 0, 0.005},
};

auto cellOf(const Record& r) {
    const SweepStep step = r.sweep.value_or(SweepStep{});
    return std::tuple(r.scene, r.variant, r.profile, r.width, r.height, r.seed, step.axis, step.curve, step.value);
}

void requireOneEnvironment(const Record& base, const Record& head) {
    if (!base.cost.instructions || !head.cost.instructions) return;
    const auto of = [](const Environment& e) {
        return fmt::format("{}, {}, {} raster threads, {} bits, {}, {}", e.renderer, e.gl, e.rasterThreads, e.vectorBits,
                           e.valgrind.value_or("no Valgrind"), e.cpu);
    };
    if (of(base.environment) == of(head.environment)) return;
    throw Inconclusive(fmt::format("instructions counted in different environments cannot be compared: base \"{}\", head "
                                   "\"{}\"; count both on one machine",
                                   of(base.environment), of(head.environment)));
}

void requireOneTruth(const Record& base, const Record& head) {
    const auto key = [](const std::optional<ReferenceInfo>& reference) { return reference ? reference->key : ""; };
    if (key(base.reference) == key(head.reference) && key(base.softReference) == key(head.softReference)) return;
    throw Inconclusive(fmt::format("{} on {} was scored against different truths: the scene or the ground truth changed, so "
                                   "the records cannot be compared; make the base's again",
                                   head.variant, head.scene));
}

/// How much of a change in `metric` may be the truth's own error, a stray pixel or noise.
double allowance(const Watched& metric, const Record& base, double value) {
    const double pixels = metric.pixels / (static_cast<double>(base.width) * base.height);
    const ReferenceInfo none;
    const double sigma = (base.softReference ? base.softReference : base.reference).value_or(none).sigma;
    // An error e measured against a truth that is off by σ reads √(e² + σ²).
    const double truth = metric.graded ? std::hypot(value, sigma) - value : 0;
    return std::max(pixels, truth) + metric.relative * std::abs(value); // what exceeds lod-full's may be negative
}

Direction directionOf(double base, double head, double allowance) {
    if (head > base + allowance) return Direction::Worse;
    return head < base - allowance ? Direction::Better : Direction::Same;
}

std::string changed(const Watched& metric, const Record& record, double base, double head) {
    return fmt::format("{} on {}: {} {} → {}{}", record.variant, record.scene, metric.metric, base, head,
                       base > 0 ? fmt::format(" ({:+.2f} %)", 100 * (head / base - 1)) : "");
}

/// One curve of a sweep: its values from harmless to hard and where on it the tolerance was first exceeded.
struct Curve {
    const Record* first = nullptr;
    std::vector<double> values;

    /// One past the last where nothing broke.
    [[nodiscard]] std::ptrdiff_t breakIndex() const {
        const auto& point = first->sweep->breakPoint;
        return (point ? std::ranges::find(values, *point) : values.end()) - values.begin();
    }
    [[nodiscard]] std::string breakText() const {
        const auto& point = first->sweep->breakPoint;
        return point ? fmt::format("breaks at {:g} {}", *point, first->sweep->unit) : "does not break";
    }
};

using Curves = std::map<std::tuple<std::string, std::string, std::string>, Curve>;

Curves curvesOf(const std::vector<Record>& records) {
    Curves curves;
    for (const Record& record : records) {
        if (!record.sweep) continue;
        Curve& curve = curves[{record.scene, record.sweep->axis, record.sweep->curve}];
        if (curve.first == nullptr) curve.first = &record;
        curve.values.push_back(record.sweep->value);
    }
    return curves;
}

void compareBreakPoints(const Curves& base, const Curves& head, std::vector<Change>& changes) {
    for (const auto& [key, curve] : head) {
        const auto found = base.find(key);
        if (found == base.end() || found->second.values != curve.values) continue; // other places: nothing to compare
        const std::ptrdiff_t was = found->second.breakIndex(), is = curve.breakIndex();
        const SweepStep& step = *curve.first->sweep;
        changes.push_back({curve.first->scene, step.curve, "sweep.break_point", Class::BreakPoint,
                           found->second.first->sweep->breakPoint, step.breakPoint, 0,
                           is < was   ? Direction::Worse
                           : is > was ? Direction::Better
                                      : Direction::Same,
                           fmt::format("{} on {} along {}: it {}, before it {}", step.curve, curve.first->scene, step.axis,
                                       curve.breakText(), found->second.breakText())});
    }
}

Change statusChange(const Record& record, Direction direction, const std::string& what) {
    return {record.scene,
            record.variant,
            "status",
            Class::Status,
            {},
            {},
            0,
            direction,
            fmt::format("{} on {} {}", record.variant, record.scene, what)};
}

bool scored(const Record& record) { return record.status == Status::Scored; }

void compareCells(const Record& base, const Record& head, std::vector<Change>& changes) {
    if (scored(base) != scored(head)) {
        const std::string what = fmt::format("was {} and is {}{}{}", name(base.status), name(head.status),
                                             head.reason.empty() ? "" : ": ", head.reason);
        changes.push_back(statusChange(head, scored(base) ? Direction::Worse : Direction::Better, what));
    }
    if (!scored(base) || !scored(head)) return;
    requireOneTruth(base, head);
    requireOneEnvironment(base, head);
    for (const Watched& metric : watched) {
        const auto before = metric.value(base), now = metric.value(head);
        if (!before) continue;
        Change change{head.scene, head.variant, std::string(metric.metric), metric.watchedClass, before, now, 0, {}, {}};
        if (now) {
            change.allowance = allowance(metric, base, *before);
            change.direction = directionOf(*before, *now, change.allowance);
            change.sentence = changed(metric, head, *before, *now);
        } else {
            change.direction = Direction::Worse;
            change.sentence = fmt::format("{} on {}: {} is no longer measured", head.variant, head.scene, metric.metric);
        }
        changes.push_back(std::move(change));
    }
}

} // namespace

std::string_view name(Class c) {
    switch (c) {
    case Class::Labels:
        return "labels";
    case Class::FalseShadow:
        return "false shadow";
    case Class::Leak:
        return "leak";
    case Class::Edge:
        return "edge";
    case Class::Penumbra:
        return "penumbra";
    case Class::Colour:
        return "colour";
    case Class::Flicker:
        return "flicker";
    case Class::BreakPoint:
        return "break point";
    case Class::Instructions:
        return "instructions";
    case Class::Status:
        return "status";
    }
    return "";
}

std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head) {
    std::map<decltype(cellOf(base.front())), const Record*> before;
    for (const Record& record : base) before[cellOf(record)] = &record;
    std::vector<Change> changes;
    for (const Record& record : head) {
        const auto found = before.find(cellOf(record));
        if (found == before.end()) {
            changes.push_back(statusChange(record, Direction::Same, "is new"));
            continue;
        }
        compareCells(*found->second, record, changes);
        before.erase(found);
    }
    for (const Record& record : base)
        if (before.contains(cellOf(record)))
            changes.push_back(statusChange(record, Direction::Worse, "is no longer measured"));
    compareBreakPoints(curvesOf(base), curvesOf(head), changes);
    return changes;
}

} // namespace shadowbench::gate
