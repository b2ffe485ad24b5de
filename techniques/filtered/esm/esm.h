// The mathematics of exponential shadow maps, as filtered/esm/*.frag compute it.
#pragma once

namespace shadowbench::techniques {

/// The test of a receiver at `depth` against the filtered mean of exp(c z): the mean of exp(−c (depth − z)), 1 at most.
double exponentialTest(double depth, double meanExponential, double c);

/// How far before a receiver a single occluder has to be for its shadow to be at most `visibility` bright.
double exponentialReach(double visibility, double c);

} // namespace shadowbench::techniques
