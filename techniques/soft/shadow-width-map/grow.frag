// One pass: a texel becomes wider if its whole neighbourhood has become so in every pass before. The neighbourhood reaches STEP_X and
// STEP_Y texels to each side, 0 or 1. What has not become wider itself looks at no neighbour: a loop of no turns, which a software
// rasteriser leaves at once, where it runs both sides of an `if`.
uniform sampler2D widths;
uniform int done;  // passes before

out float width;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(widths, 0) - 1;
    width = texelFetch(widths, texel, 0).r;
    const int columns = 2 * STEP_X + 1, all = columns * (2 * STEP_Y + 1);
    int looks = width > float(done) ? all : 0;
    float narrowest = width;
    for (int i = 0; i < looks; ++i) {
        ivec2 neighbour = texel + ivec2(i % columns - STEP_X, i / columns - STEP_Y);
        narrowest = min(narrowest, texelFetch(widths, clamp(neighbour, ivec2(0), last), 0).r);
    }
    if (narrowest > float(done)) width = float(done) + 1.5;
}
