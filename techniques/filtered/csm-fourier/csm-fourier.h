// The mathematics of convolution shadow maps, as the shaders under filtered/csm-fourier/ compute it.
#pragma once

namespace shadowbench::techniques {

/// The angular frequency c_k of term k ≥ 1: of a square wave whose period is twice the depth range.
double fourierFrequency(int k);

/// The weight of term k of `terms` in a series whose high frequencies are damped: exp(−damping (k / terms)²).
double fourierDamping(int k, int terms, double damping);

/// The step 0 → 1 at x = 0 by `terms` terms: ½ + 2 Σ sin(c_k x) / c_k, damped. For abs(x) < 1.
double fourierStep(double x, int terms, double damping);

/// The share of the unit depth range that depths are stored over: the series is a wave, and what lies the whole range before
/// a receiver must not come near the wave's next step.
double usedDepth(int terms);

/// What the series is multiplied with so that a surface, which finds its own depth in the map, is lit in spite of damping
/// and 8-bit storage: it is tested `offset` before itself.
double litGain(int terms, double damping, double offset);

} // namespace shadowbench::techniques
