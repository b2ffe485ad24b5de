// Where in a shadow map a pixel's receiver is tested: with NORMAL_OFFSET, where it is moved to.
#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"
#include "shared/maps/normal_offset.glsl"

MapPoint testedPoint(Receiver receiver) {
#ifdef NORMAL_OFFSET
    return mapPoint(movedReceiver(receiver.position, normalAt(gl_FragCoord.xy)));
#else
    return mapPoint(receiver.position);
#endif
}
