// The mean of both depths is taken here, for the texels that receivers fall into, and not for every texel of a third map.
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"
#include "shared/maps/midpoint.glsl"

uniform sampler2D firstDepth;
uniform sampler2D secondDepth;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    float middle = midpoint(texture(firstDepth, point.at.xy).r, texture(secondDepth, point.at.xy).r);
    if (point.at.z > middle) visibility = 0.0;
}
