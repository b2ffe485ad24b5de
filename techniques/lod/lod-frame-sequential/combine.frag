// Combination of the newer and the older LOD buffer (dissertation 5.1.4, listing 6.3).
// REPROJECT 0: the older buffer is read at the same pixel; 1: where the camera saw the point (eq. 5.2); 2: and where the point's
// instance was.
uniform sampler2D newColour;
uniform usampler2D newData;
uniform sampler2D oldColour;
uniform usampler2D oldData;

#if REPROJECT > 0
uniform mat4 oldFromNew;  // clip space
uniform vec2 clipDepth;   // clip z = clipDepth.x · depth + clipDepth.y
#endif
#if REPROJECT == 2
layout(std430, binding = 0) readonly buffer Motions { mat4 oldFromNewOf[]; };  // by id
uniform int motions;
#endif

layout(location = 0) out vec4 colour;

struct Fragment {
    vec4 colour;
    float depth;  // metres along the view direction
    uint id;      // 0: not in transition
};

Fragment fetch(sampler2D colours, usampler2D data, ivec2 pixel) {
    uint depthAndId = texelFetch(data, pixel, 0).r;
    return Fragment(texelFetch(colours, pixel, 0), unpackHalf2x16(depthAndId).x, depthAndId >> 16);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(newColour, 0);
    Fragment newer = fetch(newColour, newData, pixel);
    colour = newer.colour;

    ivec2 oldPixel = pixel;
    float depth = newer.depth;  // as the older buffer counts it
#if REPROJECT > 0
    vec2 onScreen = 2.0 * gl_FragCoord.xy / vec2(size) - 1.0;
    vec4 clip = vec4(onScreen * depth, clipDepth.x * depth + clipDepth.y, depth);
#if REPROJECT == 2
    mat4 toOld = newer.id != 0u && int(newer.id) < motions ? oldFromNewOf[newer.id] : oldFromNew;
#else
    mat4 toOld = oldFromNew;
#endif
    vec4 old = toOld * clip;
    if (old.w <= 0.0 || any(greaterThanEqual(abs(old.xy), vec2(old.w)))) return;  // outside the older buffer
    oldPixel = min(ivec2((0.5 * old.xy / old.w + 0.5) * vec2(size)), size - 1);
    depth = old.w;
#endif
    Fragment older = fetch(oldColour, oldData, oldPixel);

    if (newer.id == 0u && older.id == 0u) return;                                         // neither is in transition
    if (newer.id == older.id) colour = 0.5 * (newer.colour + older.colour);               // two levels of one instance
    else if (older.depth < depth) colour = older.colour;                                  // the nearer one
}
