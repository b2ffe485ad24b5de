// The layers that begin or end where the eye's ray through a pixel meets a quad, if it does so before the pixel's surface point: if point
// and eye lie on different sides of it.
#include "gl/receiver.glsl"
#include "volumes/hidden_side.glsl"

flat in vec4 edgeFrom;  // w: its layers
flat in vec3 edgeTo;

uniform vec3 middle;

out float layers;

void main() {
    bool hidden = onHiddenSide(edgeFrom.xyz, edgeTo, middle, receiverAt(gl_FragCoord.xy).position);
    layers = hidden != gl_FrontFacing ? 0.0 : hidden ? edgeFrom.w : -edgeFrom.w;
}
