// One LOD buffer: colour, depth and instance id (listing 5.1). TRANSITION: instances whose fragments the visibility texture picks.
#include "lod/shading.glsl"

layout(location = 0) out vec4 colour;
layout(location = 1) out uint depthAndId;  // a 16-bit float and, above it, 16 bits of id

#ifdef TRANSITION
in vec3 object;
flat in float visibility;
flat in uint id;

uniform sampler2D visibilityTexture;

/// The texture repeats every metre of object space.
float visibilityAt(vec3 p) {
    ivec2 side = textureSize(visibilityTexture, 0);
    ivec2 texel = ivec2(floor(fract(p.xy + p.z) * vec2(side)));
    return texelFetch(visibilityTexture, min(texel, side - 1), 0).r;
}
#else
const uint id = 0u;
#endif

void main() {
    colour = vec4(shaded(), 1.0);
#ifdef TRANSITION
    if (visibilityAt(object) > visibility) discard;  // eq. 5.1
#endif
    float depth = 1.0 / gl_FragCoord.w;  // along the view direction, metres
    depthAndId = packHalf2x16(vec2(depth, 0.0)) | id << 16;
}
