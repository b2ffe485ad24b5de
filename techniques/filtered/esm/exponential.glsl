// The test of exponential shadow maps (Annen et al. 2008).

/// The mean of exp(−c (depth − z)) over the occluder depths z of a kernel, of which `meanExponential` is the mean of exp(c z). It exceeds
/// 1 where some of them lie behind the receiver.
float meanTest(float depth, float meanExponential, float c) {
    return exp(-c * depth) * meanExponential;
}

/// Visibility by that mean.
float exponentialTest(float mean) {
    return min(mean, 1.0);
}
