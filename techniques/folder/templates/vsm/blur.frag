uniform sampler2D SOURCE;

out vec2 mean;

void main() {
    ivec2 last = textureSize(SOURCE, 0) - 1;
    vec2 sum = vec2(0.0);
    for (int i = 0; i < KERNEL; ++i)
        sum += texelFetch(SOURCE, clamp(ivec2(gl_FragCoord.xy) + (i - KERNEL / 2) * STEP, ivec2(0), last), 0).rg;
    mean = sum / float(KERNEL);
}
