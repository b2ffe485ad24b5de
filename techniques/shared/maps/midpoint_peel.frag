// Second surface: whatever lies behind the first one of this texel. The first surface is the same fragment to the last bit, so equality
// peels exactly it.
uniform sampler2D firstDepth;

void main() {
    if (gl_FragCoord.z <= texelFetch(firstDepth, ivec2(gl_FragCoord.xy), 0).r) discard;
}
