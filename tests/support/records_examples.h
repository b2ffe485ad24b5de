// Records of every status, filled in by hand.
#pragma once

#include "harness/records/record.h"

namespace shadowbench::test {

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
    r.time = "2026-01-02T03:04:05Z";
    r.environment = {
        "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6", "some cpu", "GCC 12.2.0", 0, 256, {}};
    r.reference = ReferenceInfo{"polygon", "feed", 0, 0, {{"CGAL", "5.5.1"}}};
    r.accuracy.mismatch = 0.0009;
    r.accuracy.mismatchOffEdge = 0.0001;
    r.accuracy.falseShadow = 0.0005;
    r.accuracy.leak = 0.0004;
    r.accuracy.edgeError = EdgeError{0.4, 0.9, 1.7, -0.1};
    r.accuracy.primaryMismatch = 0.00002;
    r.aliasing = Aliasing{1.8, 4.2, 0.97};
    r.figures = {{"confident", 0.31}, {"tiles", 6}};
    r.stability.flicker = Flicker{0.001, 0.01};
    r.stability.flipRate = 0.0003;
    r.stability.movingRmse = 0.03;
    r.stability.disocclusionError = 0.07;
    r.stability.convergence = 31;
    r.stability.mismatchByFrame = {0.05, 0.01, 0.0009};
    r.stability.changedByFrame = {0.04, 0.008, 0};
    r.cost.time = Time{21.4, 23, 0.4, 1.19, 0.31, 1.08, {21.4, 21.2, 23}};
    r.cost.work = Work{65536, 70490, 140980, 3, 2, 4194304};
    r.tolerance = 0.005;
    r.toleranceMetric = "mismatch";
    return r;
}

inline Record softRecord() {
    Record r = hardRecord();
    r.scene = "overlapping-occluders";
    r.technique = "pcss";
    r.variant = "pcss:taps=32+32";
    r.reference = ReferenceInfo{"povray", "beef", 1024, 0.0006, {{"povray", "3.7.0.10.unofficial"}}};
    r.aliasing.reset();
    r.figures.clear();
    r.accuracy = {};
    r.accuracy.rmse = 0.031;
    r.accuracy.mae = 0.007;
    r.accuracy.psnr = 30.17;
    r.accuracy.bad30 = 0.012;
    r.accuracy.bad8 = 0.031;
    r.accuracy.ssim = 0.981;
    r.accuracy.penumbraRmse = 0.09;
    r.accuracy.penumbraWidthError = 0.21;
    r.accuracy.umbraLeak = 0.004;
    r.accuracy.unresolved = 0.02;
    r.stability.mismatchByFrame.clear();
    r.stability.rmseByFrame = {0.2, 0.031};
    r.stability.bad30ByFrame = {0.1, 0.012};
    r.cost.instructions = 310442871;
    r.environment.valgrind = "3.19.0";
    r.tolerance = 0.05;
    r.toleranceMetric = "penumbra_rmse";
    return r;
}

inline Record lodRecord() {
    Record r = hardRecord();
    r.scene = "windmills";
    r.technique = "lod-frame-sequential";
    r.variant = "lod-frame-sequential:vis=checker";
    r.parameters = {{"vis", "checker"}, {"reproject", "camera"}};
    r.reference.reset();
    r.accuracy = {};
    r.stability = {};
    r.cost.time.reset();
    Lod lod;
    lod.pop = 0.0011;
    lod.changedRegion = 41;
    lod.walkPop = -0.0002;
    lod.colourError = 0.064;
    lod.noise = -0.003;
    lod.transitions = 19;
    lod.primitives = 8694.5;
    lod.primitiveChange = 0.019;
    lod.time = LodTime{4.5, 1.1, 0.03};
    lod.popByFrame = {0.0011, 0.0004};
    lod.walkPopByFrame = {-0.0003, -0.0002};
    lod.primitivesByFrame = {8700, 8700, 8683.5};
    lod.millisecondsByFrame = {4.5, 4.6, 4.4};
    r.lod = lod;
    r.toleranceMetric.clear();
    r.tolerance = 0;
    return r;
}

inline Record unscored(Status status, const std::string& reason) {
    Record r = hardRecord();
    r.status = status;
    r.reason = reason;
    r.reference.reset();
    r.accuracy = {};
    r.aliasing.reset();
    r.figures.clear();
    r.stability = {};
    r.cost = {};
    return r;
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
