// Intensity that a cone or sheet leaves on what the shadow map sees (dissertation, eq. 2.2).
#include "shared/maps/linearised_map.glsl"

in float depth;          // Z_F
in float acrossSurface;  // Z_v, which a sheet interpolates between its vertices

out float intensity;

void main() {
    float receiver = linearDepth(texelFetch(windowDepths, ivec2(gl_FragCoord.xy), 0).r);  // Z_P
    if (depth >= receiver) discard;
    // No vertex lies behind its cone, but rounding may put it there, and the receiver of a contact between the two.
    intensity = clamp((depth - acrossSurface) / (receiver - acrossSurface), 0.0, 1.0);
}
