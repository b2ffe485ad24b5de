// The record's shape, once: every key with its member, in schema order. A visitor writes JSON, reads it or makes columns of
// it.
//
// visit(key, member)            a value, a list, an optional one, or a struct that has its own fields() below
// visit.group(key, has, inner)  an object of the record that is no struct here; `has`: there is something in it
// visit.metric(key, line, values) the value or list of a line of the table of metrics
// visit.text(key, member)       text that is left out when empty
// visit.objects(key, list)      a list of structs that have their own fields() below; left out when empty
// visit.size(key, width, height), visit.parameters(key, list), visit.figures(key, map), visit.bounds(key, map)
#pragma once

#include "harness/records/record.h"

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>

namespace shadowbench::records {

template <typename T, typename U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

/// The metrics of `lines`, nested by the dots of their paths; the first `depth` characters of the paths are already known.
void metricFields(auto& visit, std::span<const metrics::Metric> lines, std::size_t depth, auto& values) {
    while (!lines.empty()) {
        const std::string_view path = lines.front().path;
        const std::size_t dot = path.find('.', depth);
        const std::string key(path.substr(depth, dot == std::string_view::npos ? dot : dot - depth));
        std::size_t inside = 0; // lines of the same object
        while (dot != std::string_view::npos && inside < lines.size() &&
               lines[inside].path.starts_with(path.substr(0, dot + 1)))
            ++inside;
        if (inside == 0)
            visit.metric(key.c_str(), lines.front(), values);
        else
            visit.group(key.c_str(), values.any(lines.first(inside)),
                        [&](auto& inner) { metricFields(inner, lines.first(inside), dot + 1, values); });
        lines = lines.subspan(std::max<std::size_t>(inside, 1));
    }
}

/// An object of metrics that stands at the record's own level: "accuracy".
void metricGroup(auto& visit, const char* key, bool has, auto& values) {
    visit.group(key, has,
                [&](auto& inner) { metricFields(inner, metrics::linesOf(key), std::string_view(key).size() + 1, values); });
}
void metricGroup(auto& visit, const char* key, auto& values) {
    metricGroup(visit, key, values.any(metrics::linesOf(key)), values);
}

void fields(auto& visit, Is<Environment> auto& e) {
    visit("renderer", e.renderer);
    visit("gl", e.gl);
    visit("raster_threads", e.rasterThreads);
    visit("vector_bits", e.vectorBits);
    visit("cpu", e.cpu);
    visit("compiler", e.compiler);
    visit("valgrind", e.valgrind);
    visit.text("cpu_features", e.cpuFeatures);
    visit.text("mesa", e.mesa);
    visit.text("libraries", e.libraries);
    visit.text("platform", e.platform);
    visit.text("vendor", e.vendor);
    visit.text("driver", e.driver);
}

void fields(auto& visit, Is<AreaInfo> auto& a) {
    visit("key", a.key);
    visit("content", a.content);
    visit("rms", a.rms);
    visit("rmse", a.rmse);
}

void fields(auto& visit, Is<ReferenceInfo> auto& r) {
    visit("oracle", r.oracle);
    visit("key", r.key);
    visit("samples", r.samples);
    visit("sigma", r.sigma);
    visit("tools", r.tools);
    visit.text("content", r.content);
    visit("area", r.area);
}

void fields(auto& visit, Is<SweepStep> auto& s) {
    visit("axis", s.axis);
    visit("unit", s.unit);
    visit("curve", s.curve);
    visit("value", s.value);
    visit("break_point", s.breakPoint);
}

void fields(auto& visit, Is<PassRecord> auto& p) {
    visit("name", p.name);
    visit("runs", p.runs);
    visit("milliseconds", p.milliseconds);
    visit("share", p.share);
    visit("fragments", p.fragments);
    visit("vertices", p.vertices);
    visit("draws", p.draws);
    visit.text("drawn_with", p.drawnWith);
}

void fields(auto& visit, Is<OtherScreen> auto& o) {
    visit.size("size", o.width, o.height);
    visit.objects("by_pass", o.passes);
}

void fields(auto& visit, Is<DeviceCost> auto& d) {
    visit.size("size", d.width, d.height);
    visit("median", d.median);
    visit("mad", d.mad);
    visit("ratio", d.ratio);
    visit("processor", d.processor);
    visit("motion", d.motion);
    visit("first", d.first);
    visit.objects("by_pass", d.passes);
}

void fields(auto& visit, Is<PassTerms> auto& p) {
    visit("name", p.name);
    visit("arithmetic", p.arithmetic);
    visit("texture", p.texture);
    visit("output", p.output);
    visit("geometry", p.geometry);
    visit("memory", p.memory);
    visit("fixed", p.fixed);
}

void fields(auto& visit, Is<ModelledCost> auto& m) {
    visit("milliseconds", m.milliseconds);
    visit("least", m.least);
    visit("most", m.most);
    visit("waits", m.waits);
    visit.objects("by_pass", m.passes);
    visit("motion", m.motion);
    visit.objects("motion_by_pass", m.motionPasses);
    visit("cold", m.cold);
    visit.objects("cold_by_pass", m.coldPasses);
}

void fields(auto& visit, Is<ReportedCost> auto& r) {
    visit("milliseconds", r.milliseconds);
    visit.text("device", r.device);
}

void fields(auto& visit, Is<ExternalInfo> auto& e) {
    visit.text("title", e.title);
    visit.text("source", e.source);
    visit.text("revision", e.revision);
    visit("reported", e.reported);
}

void costFields(auto& visit, Is<Record> auto& r) {
    constexpr std::string_view key = "cost";
    visit.group(key.data(), r.values.any(metrics::linesOf(key)) || !r.passes.empty(), [&](auto& inner) {
        metricFields(inner, metrics::linesOf(key), key.size() + 1, r.values);
        inner.objects("by_pass", r.passes);
        inner.objects("motion_by_pass", r.motionPasses);
        inner.objects("cold_by_pass", r.coldPasses);
        inner("other_screen", r.otherScreen);
        inner.objects("device", r.deviceCosts);
        inner.named("gpu", r.modelled);
    });
}

/// Scored against a truth: a level-of-detail record is not.
inline bool hasAccuracy(const Record& r) { return wasScored(r.status) && !isLevelOfDetail(r); }

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
    visit.text("program", r.program);
    visit.text("metric_code", r.metricCode);
    visit.text("images", r.images);
    visit.text("truths", r.truths);
    visit("time", r.time);
    visit("environment", r.environment);
    visit("reference", r.reference);
    visit("soft_reference", r.softReference);
    visit("pixel_reference", r.pixelReference);
    visit("sweep", r.sweep);
    metricGroup(visit, "lod", r.values);
    metricGroup(visit, "accuracy", hasAccuracy(r), r.values);
    metricGroup(visit, "views", r.values);
    metricGroup(visit, "sanity", r.values);
    metricGroup(visit, "aliasing", r.values);
    metricGroup(visit, "off_geometry_edges", r.values);
    visit.figures("figures", r.figures);
    metricGroup(visit, "stability", r.values);
    costFields(visit, r);
    visit("external", r.external);
    visit.bounds("tolerances", r.tolerances);
}

} // namespace shadowbench::records
