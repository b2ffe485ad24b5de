// A level of a min/max pyramid from the one before it.
uniform sampler2D finer;

out vec2 range;

void main() {
    ivec2 low = 2 * ivec2(gl_FragCoord.xy);
    vec2 a = texelFetch(finer, low, 0).rg;
    vec2 b = texelFetch(finer, low + ivec2(1, 0), 0).rg;
    vec2 c = texelFetch(finer, low + ivec2(0, 1), 0).rg;
    vec2 d = texelFetch(finer, low + ivec2(1, 1), 0).rg;
    range = vec2(max(max(a.x, b.x), max(c.x, d.x)), min(min(a.y, b.y), min(c.y, d.y)));
}
