// One pass: the mean width of a texel's neighbourhood, which reaches STEP_X and STEP_Y texels to each side, 0 or 1. What is no
// occluder keeps a width of 0 and looks at no neighbour (soft/shadow-width-map/grow.frag).
uniform sampler2D widths;

out float width;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(widths, 0) - 1;
    const int columns = 2 * STEP_X + 1, all = columns * (2 * STEP_Y + 1);
    int looks = texelFetch(widths, texel, 0).r > 0.0 ? all : 0;
    width = 0.0;
    for (int i = 0; i < looks; ++i) {
        ivec2 neighbour = texel + ivec2(i % columns - STEP_X, i / columns - STEP_Y);
        width += texelFetch(widths, clamp(neighbour, ivec2(0), last), 0).r / float(all);
    }
}
