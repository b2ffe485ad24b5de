#include "gl/receiver.glsl"

void main() {
    if (receiverAt(gl_FragCoord.xy).seen) discard;
}
