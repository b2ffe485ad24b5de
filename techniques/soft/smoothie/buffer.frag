// Depth and alpha of a smoothie (course, "Computing Alpha").
in float depth;
noperspective in float acrossImage;

uniform sampler2D linearDepth;

out vec2 smoothie;

void main() {
    float receiver = abs(texelFetch(linearDepth, ivec2(gl_FragCoord.xy), 0).r);
    if (depth >= receiver) discard;
    smoothie = vec2(depth, acrossImage / (1.0 - depth / receiver));
}
