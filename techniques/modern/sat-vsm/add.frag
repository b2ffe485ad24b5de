// One of the passes of a summed area: of each texel's sum and those of three before it along STEP (Hensley et al. 2005). After n of them a
// texel holds the sum of 4ⁿ.
uniform usampler2D SOURCE;
uniform int repetition;

out uvec2 sum;

void main() {
    ivec2 apart = STEP << (4 * repetition + 2 * TURN);  // 4 to the power of the passes before
    sum = uvec2(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 before = ivec2(gl_FragCoord.xy) - i * apart;
        if (all(greaterThanEqual(before, ivec2(0)))) sum += texelFetch(SOURCE, before, 0).rg;
    }
}
