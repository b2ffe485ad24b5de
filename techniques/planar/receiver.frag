#include "planar/receiver.glsl"

void main() {
    if (!seesReceiver(gl_FragCoord.xy)) discard;
}
