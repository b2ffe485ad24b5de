#include "harness/records/compare.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace shadowbench::gate {
namespace {

/// Rendering is the same to the bit from run to run, so the only allowance that exact truths need is for what an innocent
/// change of rounding may do: a pixel or two whose centre lies on an edge.
constexpr double onePixel = 1, twoPixels = 2;
constexpr double strayEdge = 0.002; // px: two pixels beside an edge of a thousand, as long as the scenes' are

std::optional<double> lodScore(const Record& record, double Lod::*score) {
    return record.lod ? std::optional(*record.lod.*score) : std::nullopt;
}

constexpr std::array watched{
    Watched{"accuracy.mismatch", Class::Labels, [](const Record& r) { return r.accuracy.mismatch; }, Graded::No, twoPixels},
    Watched{"accuracy.false_shadow", Class::FalseShadow, [](const Record& r) { return r.accuracy.falseShadow; }, Graded::No,
            twoPixels},
    Watched{"accuracy.leak", Class::Leak, [](const Record& r) { return r.accuracy.leak; }, Graded::No, twoPixels},
    Watched{"accuracy.mismatch_off_edge", Class::Labels, [](const Record& r) { return r.accuracy.mismatchOffEdge; },
            Graded::No, onePixel},
    Watched{"accuracy.edge_error.mean", Class::Edge,
            [](const Record& r) { return r.accuracy.edgeError ? std::optional(r.accuracy.edgeError->mean) : std::nullopt; },
            Graded::No, 0, 0.01, strayEdge},
    Watched{"accuracy.edge_error.signed", Class::Edge,
            [](const Record& r) {
                return r.accuracy.edgeError ? std::optional(std::abs(r.accuracy.edgeError->signedMean)) : std::nullopt;
            },
            Graded::No, 0, 0.01, strayEdge},
    Watched{"accuracy.rmse", Class::Penumbra, [](const Record& r) { return r.accuracy.rmse; }, Graded::Rms},
    Watched{"accuracy.penumbra_rmse", Class::Penumbra, [](const Record& r) { return r.accuracy.penumbraRmse; }, Graded::Rms},
    Watched{"accuracy.umbra_leak", Class::Leak, [](const Record& r) { return r.accuracy.umbraLeak; }, Graded::Mean},
    Watched{"accuracy.bad30", Class::Penumbra, [](const Record& r) { return r.accuracy.bad30; }, Graded::No, twoPixels},
    Watched{"stability.flicker.mean", Class::Flicker,
            [](const Record& r) { return r.stability.flicker ? std::optional(r.stability.flicker->mean) : std::nullopt; },
            Graded::Mean, 0, 0.01},
    Watched{"stability.flip_rate", Class::Flicker, [](const Record& r) { return r.stability.flipRate; }, Graded::No,
            twoPixels, 0.01},
    Watched{"stability.moving_rmse", Class::Flicker, [](const Record& r) { return r.stability.movingRmse; }, Graded::Rms, 0,
            0.01},
    Watched{"stability.convergence", Class::Flicker,
            [](const Record& r) {
                return r.stability.convergence ? std::optional<double>(*r.stability.convergence) : std::nullopt;
            }},
    Watched{"lod.pop", Class::Flicker, [](const Record& r) { return lodScore(r, &Lod::pop); }, Graded::No, 0, 0.01},
    Watched{"lod.walk_pop", Class::Flicker, [](const Record& r) { return lodScore(r, &Lod::walkPop); }, Graded::No,
            twoPixels, 0.01},
    Watched{"lod.colour_error", Class::Colour, [](const Record& r) { return lodScore(r, &Lod::colourError); }, Graded::No, 0,
            0.01},
    Watched{"lod.order_error", Class::Colour, [](const Record& r) { return lodScore(r, &Lod::orderError); }, Graded::No, 0,
            0.01},
    Watched{"lod.noise", Class::Colour, [](const Record& r) { return r.lod ? r.lod->noise : std::nullopt; }, Graded::No, 0,
            0.01},
    Watched{"cost.instructions", Class::Instructions,
            [](const Record& r) {
                return r.cost.instructions ? std::optional(static_cast<double>(*r.cost.instructions)) : std::nullopt;
            },
            Graded::No, 0, 0.005},
};

void requireOneEnvironment(const Record& base, const Record& head) {
    if (!base.cost.instructions || !head.cost.instructions) return;
    const std::string before = countingEnvironment(base.environment), now = countingEnvironment(head.environment);
    if (before == now) return;
    throw Inconclusive(fmt::format("instructions counted in different environments cannot be compared: base \"{}\", head "
                                   "\"{}\"; count both on one machine",
                                   before, now));
}

void requireOneTruth(const Record& base, const Record& head) {
    if (truthOf(base) == truthOf(head)) return;
    throw Inconclusive(fmt::format("{} on {} was scored against different truths: the scene or the ground truth changed, so "
                                   "the records cannot be compared; make the base's again",
                                   head.variant, head.scene));
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
                                       curve.breakText(), found->second.breakText()),
                           step.axis});
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
    case Class::Flicker:
        return "flicker";
    case Class::Colour:
        return "colour";
    case Class::BreakPoint:
        return "break point";
    case Class::Instructions:
        return "instructions";
    case Class::Time:
        return "time";
    case Class::Status:
        return "status";
    }
    return "";
}

std::span<const Watched> watchedMetrics() { return watched; }

double allowance(const Watched& metric, const Record& base, double value) {
    const double pixels = metric.pixels / (static_cast<double>(base.width) * base.height);
    const ReferenceInfo none;
    const double sigma = (base.softReference ? base.softReference : base.reference).value_or(none).sigma;
    // An error e measured against a truth that is off by σ reads √(e² + σ²). An exact truth is off by nothing, but the label
    // of a pixel whose centre lies on an edge is anyone's.
    const double stray = twoPixels / (static_cast<double>(base.width) * base.height);
    const double off = sigma > 0 ? sigma : metric.graded == Graded::Rms ? std::sqrt(stray) : 0;
    double truth = metric.graded == Graded::No ? 0 : std::hypot(value, off) - value;
    if (metric.graded == Graded::Mean && sigma == 0) truth = stray;
    return std::max({pixels, truth, metric.absolute}) + metric.relative * std::abs(value);
}

Direction directionOf(double base, double head, double allowance) {
    if (head > base + allowance) return Direction::Worse;
    return head < base - allowance ? Direction::Better : Direction::Same;
}

CellKey cellOf(const Record& r) {
    const SweepStep step = r.sweep.value_or(SweepStep{});
    return {r.scene, r.variant, r.profile, r.width, r.height, r.seed, step.axis, step.curve, step.value};
}

std::string countingEnvironment(const Environment& e) {
    return fmt::format("{}, {}, {} raster threads, {} bits, {}, {}", e.renderer, e.gl, e.rasterThreads, e.vectorBits,
                       e.valgrind.value_or("no Valgrind"), e.cpu);
}

std::string truthOf(const Record& record) {
    const auto key = [](const std::optional<ReferenceInfo>& reference) { return reference ? reference->key : ""; };
    return key(record.reference) + " " + key(record.softReference);
}

std::vector<Change> compare(const std::vector<Record>& base, const std::vector<Record>& head) {
    std::map<CellKey, const Record*> before;
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
