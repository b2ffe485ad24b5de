/// The depth that a midpoint map holds: between the two nearest surfaces, so that neither is close to a receiver. No shadow where there
/// is no second surface.
float midpoint(float first, float second) {
    return second < 1.0 ? 0.5 * (first + second) : 1.0;
}
