// One LOD buffer: colour, and in alpha the instance's id (listing 5.1). TRANSITION: instances whose fragments the visibility texture
// picks; all others have id 0.
#include "lod/shading.glsl"

layout(location = 0) out vec4 colour;

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
    colour = vec4(shaded(), float(id) / 255.0);
#ifdef TRANSITION
    if (visibilityAt(object) > visibility) discard;  // eq. 5.1
#endif
}
