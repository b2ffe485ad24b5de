// Two scenes of records with chosen figures.
#pragma once

#include "tests/support/records_examples.h"

namespace shadowbench::test {

/// A scored hard record with `mismatch`, and `ratio` times the cost of sm-uniform.
inline Record hardCell(const std::string& variant, double mismatch, double ratio) {
    Record r = hardRecord();
    r.variant = variant;
    r.technique = variant.substr(0, variant.find(':'));
    r.values["accuracy.mismatch"] = mismatch;
    r.values["cost.time.ratio"] = ratio;
    clear(r, "stability");
    setFlicker(r, mismatch / 3, mismatch);
    return r;
}

inline std::vector<Record> hardScene() {
    Record none = hardCell("none", 0.312, 0.31);
    none.values["accuracy.false_shadow"].reset();
    none.values["accuracy.leak"] = 1;
    clear(none, "accuracy.edge_error");
    Record history = hardCell("sm-history:base=lispsm", 0.0009, 1.19);
    history.values.list("stability.by_frame.mismatch") = {0.05, 0.01, 0.0009};
    history.values.list("stability.by_frame.changed") = {0.04, 0.008, 0};
    Record pcss = unscored(Status::NotApplicable, "needs an area light");
    pcss.variant = "pcss";
    return {none, hardCell("sm-uniform", 0.0487, 1), history, hardCell("volume-zfail", 0, 4.7), pcss};
}

inline Record softCell(const std::string& variant, double rmse, double ratio) {
    Record r = softRecord();
    r.variant = variant;
    r.technique = variant.substr(0, variant.find(':'));
    clearAccuracy(r);
    r.values["accuracy.rmse"] = rmse;
    r.values["accuracy.penumbra_rmse"] = 2 * rmse;
    r.values["cost.time.ratio"] = ratio;
    clear(r, "stability");
    return r;
}

inline std::vector<Record> softScene() {
    Record hard = softCell("sm-uniform", 0.19, 1);
    hard.softReference = hard.reference;
    hard.reference = hardRecord().reference;
    hard.values["accuracy.mismatch"] = 0.02;
    hard.values["accuracy.leak"] = 0.01;
    return {hard, softCell("pcss", 0.0312, 2.94), softCell("temporal-soft", 0.021, 2.2)};
}

} // namespace shadowbench::test
