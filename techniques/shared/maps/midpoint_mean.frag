uniform sampler2D firstDepth;
uniform sampler2D secondDepth;

void main() {
    float first = texelFetch(firstDepth, ivec2(gl_FragCoord.xy), 0).r;
    float second = texelFetch(secondDepth, ivec2(gl_FragCoord.xy), 0).r;
    gl_FragDepth = second < 1.0 ? 0.5 * (first + second) : 1.0;
}
