// The record's shape, once: every key with its member, in schema order. A visitor writes JSON, reads it or makes columns of
// it.
//
// visit(key, member)            a value, a list, an optional one, or a struct that has its own fields() below
// visit.group(key, has, inner)  an object of the record that is no struct here; `has`: there is something in it
// visit.text(key, member)       text that is left out when empty
// visit.size(key, width, height), visit.parameters(key, list), visit.figures(key, map)
#pragma once

#include "harness/records/record.h"

#include <concepts>
#include <type_traits>

namespace shadowbench::records {

template <typename T, typename U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

void fields(auto& visit, Is<EdgeError> auto& e) {
    visit("mean", e.mean);
    visit("p95", e.p95);
    visit("hausdorff", e.hausdorff);
    visit("signed", e.signedMean);
}

void fields(auto& visit, Is<Accuracy> auto& a) {
    visit("mismatch", a.mismatch);
    visit("mismatch_off_edge", a.mismatchOffEdge);
    visit("false_shadow", a.falseShadow);
    visit("leak", a.leak);
    visit("edge_error", a.edgeError);
    visit("rmse", a.rmse);
    visit("mae", a.mae);
    visit("psnr", a.psnr);
    visit("bad30", a.bad30);
    visit("bad8", a.bad8);
    visit("ssim", a.ssim);
    visit("penumbra_rmse", a.penumbraRmse);
    visit("penumbra_width_error", a.penumbraWidthError);
    visit("umbra_leak", a.umbraLeak);
    visit("unresolved", a.unresolved);
    visit("primary_mismatch", a.primaryMismatch);
}

void fields(auto& visit, Is<Aliasing> auto& a) {
    visit("median", a.median);
    visit("p95", a.p95);
    visit("mapped", a.mapped);
}

void fields(auto& visit, Is<Flicker> auto& f) {
    visit("mean", f.mean);
    visit("p95", f.p95);
}

void fields(auto& visit, Is<Stability> auto& s) {
    visit("flicker", s.flicker);
    visit("flip_rate", s.flipRate);
    visit("moving_rmse", s.movingRmse);
    visit("disocclusion_error", s.disocclusionError);
    visit("reuse", s.reuse);
    visit("convergence", s.convergence);
    const bool curves =
        !s.mismatchByFrame.empty() || !s.rmseByFrame.empty() || !s.bad30ByFrame.empty() || !s.changedByFrame.empty();
    visit.group("by_frame", curves, [&](auto& byFrame) {
        byFrame("mismatch", s.mismatchByFrame);
        byFrame("rmse", s.rmseByFrame);
        byFrame("bad30", s.bad30ByFrame);
        byFrame("changed", s.changedByFrame);
    });
}

void fields(auto& visit, Is<Time> auto& t) {
    visit("median", t.median);
    visit("p95", t.p95);
    visit("mad", t.mad);
    visit("ratio", t.ratio);
    visit("floor_ratio", t.floorRatio);
    visit("base_ratio", t.baseRatio);
    visit("samples", t.samples);
}

void fields(auto& visit, Is<Work> auto& w) {
    visit("fragments", w.fragments);
    visit("vertices", w.vertices);
    visit("primitives", w.primitives);
    visit("draws", w.draws);
    visit("passes", w.passes);
    visit("bytes", w.bytes);
}

void fields(auto& visit, Is<Cost> auto& c) {
    visit("time", c.time);
    visit("instructions", c.instructions);
    visit("work", c.work);
}

void fields(auto& visit, Is<LodTime> auto& t) {
    visit("median", t.median);
    visit("ratio", t.ratio);
    visit("spread", t.spread);
}

void fields(auto& visit, Is<Lod> auto& l) {
    visit("pop", l.pop);
    visit("changed_region", l.changedRegion);
    visit("walk_pop", l.walkPop);
    visit("colour_error", l.colourError);
    visit("noise", l.noise);
    visit("order_error", l.orderError);
    visit("transitions", l.transitions);
    visit("primitives", l.primitives);
    visit("primitive_change", l.primitiveChange);
    visit("time", l.time);
    const bool curves =
        !l.popByFrame.empty() || !l.walkPopByFrame.empty() || !l.primitivesByFrame.empty() || !l.millisecondsByFrame.empty();
    visit.group("by_frame", curves, [&](auto& byFrame) {
        byFrame("pop", l.popByFrame);
        byFrame("walk_pop", l.walkPopByFrame);
        byFrame("primitives", l.primitivesByFrame);
        byFrame("milliseconds", l.millisecondsByFrame);
    });
}

void fields(auto& visit, Is<Environment> auto& e) {
    visit("renderer", e.renderer);
    visit("gl", e.gl);
    visit("raster_threads", e.rasterThreads);
    visit("vector_bits", e.vectorBits);
    visit("cpu", e.cpu);
    visit("compiler", e.compiler);
    visit("valgrind", e.valgrind);
}

void fields(auto& visit, Is<ReferenceInfo> auto& r) {
    visit("oracle", r.oracle);
    visit("key", r.key);
    visit("samples", r.samples);
    visit("sigma", r.sigma);
    visit("tools", r.tools);
}

void fields(auto& visit, Is<SweepStep> auto& s) {
    visit("axis", s.axis);
    visit("unit", s.unit);
    visit("curve", s.curve);
    visit("value", s.value);
    visit("break_point", s.breakPoint);
}

inline bool wasScored(Status status) { return status == Status::Scored || status == Status::ExpectedFailure; }

/// Scored against a truth: a level-of-detail record is not.
inline bool hasAccuracy(const Record& r) { return wasScored(r.status) && !r.lod; }

void fields(auto& visit, Is<Record> auto& r) {
    visit("schema_version", r.schemaVersion);
    visit("scene", r.scene);
    visit("technique", r.technique);
    visit("variant", r.variant);
    visit.parameters("parameters", r.parameters);
    visit("profile", r.profile);
    visit.size("size", r.width, r.height);
    visit("frames", r.frames);
    visit("seed", r.seed);
    visit("status", r.status);
    visit.text("reason", r.reason);
    visit.text("cell", r.cell);
    visit("commit", r.commit);
    visit("dirty", r.dirty);
    visit("time", r.time);
    visit("environment", r.environment);
    visit("reference", r.reference);
    visit("soft_reference", r.softReference);
    visit("sweep", r.sweep);
    visit("lod", r.lod);
    visit.group("accuracy", hasAccuracy(r), [&](auto& inner) { fields(inner, r.accuracy); });
    visit("aliasing", r.aliasing);
    visit.figures("figures", r.figures);
    const Stability& s = r.stability;
    const bool stability = s.flicker || s.flipRate || s.reuse || s.convergence || !s.mismatchByFrame.empty() ||
                           !s.rmseByFrame.empty() || !s.bad30ByFrame.empty() || !s.changedByFrame.empty();
    visit.group("stability", stability, [&](auto& inner) { fields(inner, r.stability); });
    const bool cost = r.cost.time || r.cost.instructions || r.cost.work;
    visit.group("cost", cost, [&](auto& inner) { fields(inner, r.cost); });
    visit.group("tolerance", !r.toleranceMetric.empty(), [&](auto& inner) {
        inner("metric", r.toleranceMetric);
        inner("value", r.tolerance);
    });
}

} // namespace shadowbench::records
