// Mean over a box of `width` texels, one axis at a time; the texels at its ends count by the part that lies in it. REACH texels to
// each side of the middle have a part in it.
uniform float width;  // at most 8

#ifdef ALONG_X
uniform sampler2DArray stored;
uniform int layer;
uniform int level;

vec4 texelAt(int offset) {
    ivec2 at = ivec2(gl_FragCoord.xy) + ivec2(offset, 0);
    at.x = clamp(at.x, 0, textureSize(stored, level).x - 1);
    return texelFetch(stored, ivec3(at, layer), level);
}
#else
uniform sampler2D rows;

vec4 texelAt(int offset) {
    ivec2 at = ivec2(gl_FragCoord.xy) + ivec2(0, offset);
    at.y = clamp(at.y, 0, textureSize(rows, 0).y - 1);
    return texelFetch(rows, at, 0);
}
#endif

out vec4 mean;

void main() {
    vec4 sum = texelAt(0) * min(width, 1.0);
    for (int offset = 1; offset <= REACH; ++offset) {
        float weight = clamp(0.5 * width + 0.5 - float(offset), 0.0, 1.0);
        sum += weight * (texelAt(-offset) + texelAt(offset));
    }
    mean = sum / width;
}
