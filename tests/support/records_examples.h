// Records of every status, filled in by hand.
#pragma once

#include "harness/records/record.h"

namespace shadowbench::test {

/// Makes the metrics of an object of the record absent: "accuracy", "cost.time".
inline void clear(Record& record, std::string_view group) {
    for (const metrics::Metric& line : metrics::linesOf(group)) record.values.clear(line);
}

/// Makes the scores absent that a scored record may lack.
inline void clearAccuracy(Record& record) {
    clear(record, "accuracy");
    record.values["accuracy.primary_mismatch"] = 0;
}

inline void setEdgeError(Record& record, double mean, double p95, double hausdorff, double signedMean) {
    record.values["accuracy.edge_error.mean"] = mean;
    record.values["accuracy.edge_error.p95"] = p95;
    record.values["accuracy.edge_error.hausdorff"] = hausdorff;
    record.values["accuracy.edge_error.signed"] = signedMean;
}

inline void setFlicker(Record& record, double mean, double p95) {
    record.values["stability.flicker.mean"] = mean;
    record.values["stability.flicker.p95"] = p95;
}

inline Record hardRecord() {
    Record r;
    r.scene = "dueling-frusta";
    r.technique = "sm-history";
    r.variant = "sm-history:base=lispsm";
    r.parameters = {{"base", "lispsm"}, {"map", "1024"}, {"bias", "0.25"}, {"taps", "32+32"}};
    r.profile = "gate";
    r.width = 256;
    r.height = 256;
    r.frames = 68;
    r.cell = "0123456789abcdef";
    r.commit = "c0ffee";
    r.program = "9a55";
    r.metricCode = "5c0e";
    r.images = "1111";
    r.truths = "7247";
    r.time = "2026-01-02T03:04:05Z";
    r.environment = {
        "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6", "some cpu", "GCC 12.2.0", 0, 256, {}};
    r.environment.cpuFeatures = "family 6, model 85, stepping 7, features 77aa";
    r.environment.mesa = "libosmesa6 22.3.6-1, libllvm15 15.0.6-4";
    r.environment.libraries = "libc 2.36, libstdc++6 12.2.0-14";
    r.environment.platform = "osmesa";
    r.environment.vendor = "Mesa/X.org";
    r.environment.driver = "Mesa 22.3.6";
    r.reference = ReferenceInfo{"polygon", "feed", 0, 0, {{"CGAL", "5.5.1"}}};
    r.reference->content = "f00d";
    r.values["accuracy.mismatch"] = 0.0009;
    r.values["accuracy.mismatch_off_edge"] = 0.0001;
    r.values["accuracy.false_shadow"] = 0.0005;
    r.values["accuracy.leak"] = 0.0004;
    setEdgeError(r, 0.4, 0.9, 1.7, -0.1);
    r.values["accuracy.primary_mismatch"] = 0.00002;
    r.values["accuracy.pixels.labelled"] = 60000;
    r.values["accuracy.pixels.lit"] = 50000;
    r.values["accuracy.pixels.shadowed"] = 10000;
    r.values["accuracy.pixels.off_edge"] = 59000;
    r.values["aliasing.median"] = 1.8;
    r.values["aliasing.p95"] = 4.2;
    r.values["aliasing.mapped"] = 0.97;
    r.figures = {{"confident", 0.31}, {"tiles", 6}};
    setFlicker(r, 0.001, 0.01);
    r.values["stability.flip_rate"] = 0.0003;
    r.values["stability.moving_rmse"] = 0.03;
    r.values["stability.disocclusion_error"] = 0.07;
    r.values["stability.pixels.compared"] = 230000;
    r.values["stability.pixels.moving"] = 240000;
    r.values["stability.pixels.disoccluded"] = 4000;
    r.values["stability.convergence"] = 31;
    r.values.list("stability.by_frame.mismatch") = {0.05, 0.01, 0.0009};
    r.values.list("stability.by_frame.changed") = {0.04, 0.008, 0};
    r.values["cost.time.median"] = 21.4;
    r.values["cost.time.p95"] = 23;
    r.values["cost.time.mad"] = 0.4;
    r.values["cost.time.ratio"] = 1.19;
    r.values["cost.time.floor_ratio"] = 0.31;
    r.values["cost.time.base_ratio"] = 1.08;
    r.values.list("cost.time.samples") = {21.4, 21.2, 23};
    r.values["cost.time.processor"] = 0.01;
    r.passes = {
        {.name = "G-buffer", .runs = 1, .milliseconds = 6.6, .share = 0.3, .fragments = 32768, .vertices = 210, .draws = 2},
        {.name = "depth map",
         .runs = 2,
         .milliseconds = 15.4,
         .share = 0.7,
         .fragments = 32768,
         .vertices = 70280,
         .draws = 1},
        {.name = std::string(betweenPasses), .runs = 1, .milliseconds = 0, .share = 0}};
    r.otherScreen = OtherScreen{1024, 1024, r.passes};
    r.otherScreen->passes[0].fragments *= 16;
    r.values["cost.work.fragments"] = 65536;
    r.values["cost.work.vertices"] = 70490;
    r.values["cost.work.primitives"] = 140980;
    r.values["cost.work.draws"] = 3;
    r.values["cost.work.passes"] = 2;
    r.values["cost.work.bytes"] = 4194304;
    r.tolerances = {{"mismatch", 0.005}};
    return r;
}

/// The same drawn by a graphics processor.
inline Record deviceRecord() {
    Record r = hardRecord();
    r.environment.renderer = "NVIDIA H200/PCIe/SSE2";
    r.environment.driver = "NVIDIA 580.159.04";
    r.environment.rasterThreads = r.environment.vectorBits = 0;
    r.otherScreen.reset();
    for (const int side : {1024, 2048}) {
        const double pixels = side / 1024 * side / 1024;
        DeviceCost cost{side, side, 1.2 * pixels, 0.001, 1.1, 0.04, 1.5 * pixels, {}, r.passes};
        if (side == 1024) cost.first = 1.3;
        cost.passes[0].fragments *= static_cast<std::uint64_t>(pixels);
        r.deviceCosts.push_back(std::move(cost));
    }
    for (PassRecord& pass : r.passes) {
        pass.milliseconds.reset();
        pass.share.reset();
    }
    return r;
}

inline Record softRecord() {
    Record r = hardRecord();
    r.scene = "overlapping-occluders";
    r.technique = "pcss";
    r.variant = "pcss:taps=32+32";
    r.reference = ReferenceInfo{"povray", "beef", 1024, 0.0006, {{"povray", "3.7.0.10.unofficial"}}};
    clear(r, "aliasing");
    r.figures.clear();
    clearAccuracy(r);
    r.values["accuracy.rmse"] = 0.031;
    r.values["accuracy.mae"] = 0.007;
    r.values["accuracy.psnr"] = 30.17;
    r.values["accuracy.bad30"] = 0.012;
    r.values["accuracy.bad8"] = 0.031;
    r.values["accuracy.ssim"] = 0.981;
    r.values["accuracy.penumbra_rmse"] = 0.09;
    r.values["accuracy.penumbra_width_error"] = 0.21;
    r.values["accuracy.umbra_leak"] = 0.004;
    r.values["accuracy.unresolved"] = 0.02;
    r.values["accuracy.penumbra_plateau"] = 0.04;
    r.values["accuracy.penumbra_noise"] = 0.006;
    r.values["accuracy.umbra"] = 0.11;
    r.values["accuracy.true_umbra"] = 0.12;
    r.values["accuracy.z_correctness"] = 0.93;
    r.values["accuracy.z_correctness_2"] = 0.81;
    r.values["accuracy.z_correctness_16"] = 0.96;
    r.values["accuracy.z_correctness_30"] = 0.98;
    r.values.list("stability.by_frame.mismatch").clear();
    r.values.list("stability.by_frame.rmse") = {0.2, 0.031};
    r.values.list("stability.by_frame.bad30") = {0.1, 0.012};
    r.values["cost.instructions"] = 310442871;
    r.environment.valgrind = "3.19.0";
    r.tolerances = {{"penumbra_rmse", 0.05}};
    return r;
}

inline Record lodRecord() {
    Record r = hardRecord();
    r.scene = "windmills";
    r.technique = "lod-frame-sequential";
    r.variant = "lod-frame-sequential:vis=checker";
    r.parameters = {{"vis", "checker"}, {"reproject", "camera"}};
    r.reference.reset();
    for (const char* group : {"accuracy", "stability", "cost.time"}) clear(r, group);
    r.values["lod.pop"] = 0.0011;
    r.values["lod.changed_region"] = 41;
    r.values["lod.walk_pop"] = -0.0002;
    r.values["lod.colour_error"] = 0.064;
    r.values["lod.noise"] = -0.003;
    r.values["lod.order_error"] = 0;
    r.values["lod.transitions"] = 19;
    r.values["lod.primitives"] = 8694.5;
    r.values["lod.primitive_change"] = 0.019;
    r.values["lod.time.median"] = 4.5;
    r.values["lod.time.ratio"] = 1.1;
    r.values["lod.time.spread"] = 0.03;
    r.values.list("lod.by_frame.pop") = {0.0011, 0.0004};
    r.values.list("lod.by_frame.walk_pop") = {-0.0003, -0.0002};
    r.values.list("lod.by_frame.primitives") = {8700, 8700, 8683.5};
    r.values.list("lod.by_frame.milliseconds") = {4.5, 4.6, 4.4};
    r.tolerances.clear();
    return r;
}

inline Record unscored(Status status, const std::string& reason) {
    Record r = hardRecord();
    r.status = status;
    r.reason = reason;
    r.images.clear();
    r.reference.reset();
    r.values = {};
    r.passes.clear();
    r.otherScreen.reset();
    r.figures.clear();
    return r;
}

/// Of a build that draws something else.
inline Record drawnAnew(Record record) {
    record.images = "2222";
    return record;
}

inline Record expectedFailure() {
    Record r = hardRecord();
    r.status = Status::ExpectedFailure;
    r.reason = "mismatch must exceed 0.01";
    return r;
}

inline std::vector<Record> recordOfEveryStatus() {
    return {hardRecord(),      softRecord(),
            lodRecord(),       unscored(Status::NotApplicable, "needs an area light"),
            expectedFailure(), unscored(Status::Error, "primary hits differ on 3 % of the pixels")};
}

} // namespace shadowbench::test
