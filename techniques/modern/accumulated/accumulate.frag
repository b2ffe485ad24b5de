uniform sampler2D noisy;  // of this frame; negative where nothing is seen
uniform sampler2D previous_mean;
uniform sampler2D previousPositions;
uniform mat4 previousImageFromWorld;
uniform int historyFrames;

out float mean;

/// Least and greatest of what this frame has in the 3 × 3 pixels.
vec2 neighbourhood(ivec2 pixel, float now) {
    vec2 range = vec2(now);
    ivec2 last = textureSize(noisy, 0) - 1;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            float value = texelFetch(noisy, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).r;
            if (value >= 0.0) range = vec2(min(range.x, value), max(range.y, value));
        }
    return range;
}

/// What the frame before had where it saw the same point; false where that was beside its image.
bool remembered(ivec2 pixel, out float value) {
    vec4 h = previousImageFromWorld * vec4(texelFetch(previousPositions, pixel, 0).xyz, 1.0);
    vec2 at = h.xy / h.w / vec2(textureSize(previous_mean, 0));
    value = textureLod(previous_mean, at, 0.0).r;
    return historyFrames > 0 && h.w > 0.0 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float now = texelFetch(noisy, pixel, 0).r;
    mean = abs(now);
    float before;
    if (now >= 0.0 && remembered(pixel, before)) {
#ifdef CLAMP_NEIGHBOURHOOD
        vec2 range = neighbourhood(pixel, now);
        before = clamp(before, range.x, range.y);
#endif
        mean = mix(before, now, SHARE);
    }
}
