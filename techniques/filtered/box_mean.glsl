// One of a box's two passes, along rows or columns, over KERNEL texels; beside the target its rim goes on.

/// What a texel stores: defined by the shader that includes this.
vec4 stored(ivec2 texel);

vec4 boxMean(ivec2 size, ivec2 step) {
    ivec2 first = ivec2(gl_FragCoord.xy) - KERNEL / 2 * step;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < KERNEL; ++i) sum += stored(clamp(first + i * step, ivec2(0), size - 1));
    return sum / float(KERNEL);
}
