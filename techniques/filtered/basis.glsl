// The depth of this texel of a linear depth map, for a basis to be stored of.
uniform sampler2D linearDepth;  // metres, negative: moving caster
uniform vec2 depthRange;        // near and far

/// 0 at the near and 1 at the far distance, and where nothing is in the way.
float unitDepth() {
    float depth = abs(texelFetch(linearDepth, ivec2(gl_FragCoord.xy), 0).r);
    return clamp((depth - depthRange.x) / (depthRange.y - depthRange.x), 0.0, 1.0);
}
