// The mean of both depths is taken here, for the texels that receivers fall into, and not for every texel of a third map.
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"
#include "shared/maps/midpoint.glsl"

uniform sampler2D firstDepth;
#ifdef SECOND_SURFACE
uniform sampler2D secondDepth;
#else
uniform sampler2D backDepth;
#define secondDepth backDepth
#endif

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    float first = texture(firstDepth, point.at.xy).r;
    float middle = midpoint(first, texture(secondDepth, point.at.xy).r);
    if (first < 1.0 && point.at.z > middle) visibility = 0.0; // beside the map, where the first is 1, the second is its rim's
}
