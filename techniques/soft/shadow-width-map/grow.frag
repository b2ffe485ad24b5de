// One pass: a texel becomes wider if its whole neighbourhood has become so in every pass before. The neighbourhood reaches STEP_X and
// STEP_Y texels to each side, 0 or 1: known when compiled, for a software rasteriser masks loops of other lengths.
uniform sampler2D widths;
uniform int done;  // passes before

out float width;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(widths, 0) - 1;
    float narrowest = 1e30;
    for (int y = -STEP_Y; y <= STEP_Y; ++y)
        for (int x = -STEP_X; x <= STEP_X; ++x)
            narrowest = min(narrowest, texelFetch(widths, clamp(texel + ivec2(x, y), ivec2(0), last), 0).r);
    width = narrowest > float(done) ? float(done) + 1.5 : texelFetch(widths, texel, 0).r;
}
