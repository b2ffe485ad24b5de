#include "gl/instance.glsl"
#include "maps/sm-dual-paraboloid/paraboloid.glsl"

uniform mat4 lightFromWorld;
uniform float constantBias;

void main() {
    vec3 position = (lightFromWorld * vec4(worldPosition(objectPosition), 1.0)).xyz;
    gl_ClipDistance[0] = position.z + RIM * length(position);  // a little beyond the half space
    vec3 at = paraboloid(position);
    gl_Position = vec4(at.xy, 2.0 * (at.z + constantBias) - 1.0, 1.0);
}
