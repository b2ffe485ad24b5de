#include "harness/measure/costs.h"

namespace shadowbench {

void setWork(Record& record, const Work& work) {
    record.values["cost.work.fragments"] = static_cast<double>(work.fragments);
    record.values["cost.work.vertices"] = static_cast<double>(work.vertices);
    record.values["cost.work.primitives"] = static_cast<double>(work.primitives);
    record.values["cost.work.draws"] = static_cast<double>(work.draws);
    record.values["cost.work.passes"] = static_cast<double>(work.passes);
    record.values["cost.work.bytes"] = static_cast<double>(work.bytes);
}

void setTime(Record& record, const Time& time) {
    record.values["cost.time.median"] = time.median;
    record.values["cost.time.p95"] = time.p95;
    record.values["cost.time.mad"] = time.mad;
    record.values["cost.time.ratio"] = time.ratio;
    record.values["cost.time.floor_ratio"] = time.floorRatio;
    record.values["cost.time.base_ratio"] = time.baseRatio;
    record.values["cost.time.bare"] = time.bare;
    record.values["cost.time.bare_ratio"] = time.bareRatio;
    record.values["cost.time.processor"] = time.processorShare;
    record.values.list("cost.time.samples") = time.samples;
}

void setTime(Record& record, const LodTime& time) {
    record.values["lod.time.median"] = time.median;
    record.values["lod.time.ratio"] = time.ratio;
    record.values["lod.time.spread"] = time.spread;
}

} // namespace shadowbench
