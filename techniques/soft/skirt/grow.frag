// One pass: the skirt grows by a texel, falling off by what the way to the neighbour takes, and the least depth spreads with it. Edges
// whose depths differ by less than an outline's step share one skirt; a skirt of an edge nearer to the light covers others.
uniform sampler2D skirt;  // attenuation, 1 / depth
uniform vec2 falloff;     // per texel along x and y
uniform float leastStep;  // share of the depth behind

out vec2 grown;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(skirt, 0) - 1;
    grown = vec2(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 neighbour = texelFetch(skirt, clamp(texel + ivec2(x, y), ivec2(0), last), 0).rg;
            neighbour.r -= length(vec2(x, y) * falloff);
            if (neighbour.r <= 0.0) continue;
            float tolerance = leastStep * max(neighbour.g, grown.g);
            if (neighbour.g > grown.g + tolerance)
                grown = neighbour;
            else if (neighbour.g > grown.g - tolerance)
                grown = max(grown, neighbour);
        }
}
