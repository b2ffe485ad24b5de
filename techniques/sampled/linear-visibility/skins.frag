// A skin as the other end sees it, where nothing hides it. At the occluder, where it begins, it has to lie before the surface that this
// end sees, or it would shade the occluder itself; on the receiver, where it ends, it may lie a little behind.
uniform sampler2D otherDepth;  // linear, of this end
uniform float leastGap;        // as in skins.comp

noperspective in float shade;
noperspective in float inverse;

out float visibility;

void main() {
    float surface = 1.0 / abs(texelFetch(otherDepth, ivec2(gl_FragCoord.xy), 0).r);
    if (inverse < surface + leastGap * (1.0 - 2.0 * shade)) discard;
    visibility = shade;
}
