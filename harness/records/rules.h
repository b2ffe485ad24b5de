// How much of a change means nothing, as data: a program states it in its policy, so that a gate's base and head both judge.
#pragma once

#include "harness/metrics/table.h"

#include <map>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// What is compared of a metric, and the change that means nothing (metrics::Allowance).
struct Limit {
    metrics::TruthError truth = metrics::TruthError::None;
    double pixels = 0;
    std::string of; // path of the class's size; "": the image
    double relative = 0, absolute = 0;
    bool magnitude = false;
    double best = 0;
    metrics::Absent absent = metrics::Absent::Nothing;
};

struct Rules {
    std::map<std::string, Limit, std::less<>> limits; // by the metric's path; one without is not compared
    double strayPixels = 2;    // whose centres lie on an edge of an exact truth: their labels are arbitrary
    double figureShare = 0.25; // figures explain a technique and have no better direction: less than this share …
    double figureStep = 0.01;  // … and this much more is no change
    double seedErrors = 7.7;   // standard errors by which the means of two sets of seeds of one program may differ
    double seedSpread = 10.9;  // times the base's deviation over seeds, that the head's may be
};

/// Those of this build.
const Rules& ownRules();

/// The stricter of each number. What is compared of a metric is what the base compares.
Rules stricter(const Rules& base, const Rules& head);

/// One sentence for each number of `base` that is looser in `head`, or gone.
std::vector<std::string> loosened(const Rules& base, const Rules& head);

/// The numbers of a rule, once: visit(name, member) for each, larger is looser.
void numbers(auto& visit, auto& rules) requires requires { rules.strayPixels; }
{
    visit("stray_pixels", rules.strayPixels);
    visit("figure_share", rules.figureShare);
    visit("figure_step", rules.figureStep);
    visit("seed_errors", rules.seedErrors);
    visit("seed_spread", rules.seedSpread);
}
void numbers(auto& visit, auto& limit) requires requires { limit.pixels; }
{
    visit("pixels", limit.pixels);
    visit("relative", limit.relative);
    visit("absolute", limit.absolute);
}

} // namespace shadowbench::gate
