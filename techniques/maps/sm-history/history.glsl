// How much of this frame's shadow test a history takes in (EGSR paper, section 3; Scherzer chapter 3).

/// Eq. 3.6: 1 at the centre of a shadow-map texel, 0 at its border; `texel` is the position in the map, in texels.
float confidence(vec2 texel) {
    vec2 fromCentre = abs(fract(texel) - 0.5);
    return 1.0 - 2.0 * max(fromCentre.x, fromCentre.y);
}

/// Eq. 3.3 and 3.7: the history after this frame, whose test is of the confidence `sure` and counts with the weight sure^m.
float smoothed(float previous, float current, float sure, float m) {
    return mix(previous, current, pow(sure, m));
}
