#include "lod/shading.glsl"

flat in float visibility;

layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(shaded(), visibility);  // opacity where blending is on
}
