#include "harness/measure/costs.h"

namespace shadowbench {

namespace {

struct WorkMetrics {
    metrics::MetricId fragments, vertices, primitives, draws, passes;
};

const WorkMetrics& metricsOf(WorkOf frame) {
    static constexpr WorkMetrics standing{"cost.work.fragments", "cost.work.vertices", "cost.work.primitives",
                                          "cost.work.draws", "cost.work.passes"};
    static constexpr WorkMetrics moving{"cost.motion.work.fragments", "cost.motion.work.vertices",
                                        "cost.motion.work.primitives", "cost.motion.work.draws", "cost.motion.work.passes"};
    static constexpr WorkMetrics first{"cost.cold.work.fragments", "cost.cold.work.vertices", "cost.cold.work.primitives",
                                       "cost.cold.work.draws", "cost.cold.work.passes"};
    return frame == WorkOf::StandingFrame ? standing : frame == WorkOf::MovingFrame ? moving : first;
}

} // namespace

void setWork(Record& record, WorkOf frame, const gl::WorkCount& work) {
    const WorkMetrics& ids = metricsOf(frame);
    record.values[ids.fragments] = static_cast<double>(work.fragments);
    record.values[ids.vertices] = static_cast<double>(work.vertices);
    record.values[ids.primitives] = static_cast<double>(work.primitives);
    record.values[ids.draws] = static_cast<double>(work.draws);
    record.values[ids.passes] = static_cast<double>(work.passes);
}

void setMemory(Record& record, const Memory& memory) {
    record.values["cost.work.bytes"] = static_cast<double>(memory.bytes);
    if (memory.peak) record.values["cost.work.peak_bytes"] = static_cast<double>(*memory.peak);
}

void setTime(Record& record, const Time& time) {
    record.values["cost.time.median"] = time.median;
    record.values["cost.time.p95"] = time.p95;
    record.values["cost.time.mad"] = time.mad;
    record.values["cost.time.ratio"] = time.ratio;
    record.values["cost.time.floor_ratio"] = time.floorRatio;
    record.values["cost.time.base_ratio"] = time.baseRatio;
    record.values["cost.time.processor"] = time.processorShare;
    record.values.list("cost.time.samples") = time.samples;
}

void setTime(Record& record, const MotionTime& time) {
    record.values["cost.motion.time.median"] = time.median;
    record.values["cost.motion.time.ratio"] = time.ratio;
    record.values.list("cost.motion.time.samples") = time.samples;
}

void setTime(Record& record, const ColdTime& time) {
    record.values["cost.cold.time"] = time.frame;
    record.values["cost.cold.compile"] = time.compile;
}

void setTime(Record& record, const LodTime& time) {
    record.values["lod.time.median"] = time.median;
    record.values["lod.time.ratio"] = time.ratio;
    record.values["lod.time.spread"] = time.spread;
}

} // namespace shadowbench
