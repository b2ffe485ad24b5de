// Taps of a Vogel disk (Vogel 1979: seeds of a sunflower) and interleaved gradient noise (Jimenez 2014), which turns the disk by an
// angle of each pixel's own.
const float tau = 6.28318530718;

/// Tap i of n in the unit disk, turned by `turn` radians. Radii leave each tap as much area; the golden angle keeps neighbours apart.
vec2 vogelTap(int i, int n, float turn) {
    const float goldenAngle = 2.39996322973;
    float angle = float(i) * goldenAngle + turn;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

/// In [0, 1): an even spread over any 3 × 3 pixels.
float gradientNoise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

/// The same, moved along by each of 64 frames as engines move it, and by seeds other than 1 over whole pixels.
float gradientNoise(vec2 pixel, int frame, int seed) {
    return gradientNoise(pixel + 5.588238 * float(frame % 64) + vec2(23.0, 41.0) * float(seed - 1));
}

/// A pixel's angle by the parameter `turn`: of its own in each frame, of its own alone, or none.
float turnOf(vec2 pixel, int frame, int seed) {
#if defined(TURN_FRAME)
    return tau * gradientNoise(pixel, frame, seed);
#elif defined(TURN_PIXEL)
    return tau * gradientNoise(pixel, 0, seed);
#else
    return 0.0;
#endif
}
