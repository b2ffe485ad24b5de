// A front cap's vertex, projected from the light onto the camera's near plane. What lies behind the light has w < 0 and is clipped.
layout(location = 0) in vec4 vertex;
layout(location = 1) in vec4 worldRow0;
layout(location = 2) in vec4 worldRow1;
layout(location = 3) in vec4 worldRow2;

uniform mat4 clipFromWorld;
uniform vec4 lightSide;  // dot(·, p) ≥ 0 on the light's side of the near plane

void main() {
    vec4 p = vec4(vertex.xyz, 1.0);
    vec4 world = vec4(dot(worldRow0, p), dot(worldRow1, p), dot(worldRow2, p), 1.0);
    gl_Position = clipFromWorld * world;
    gl_ClipDistance[0] = dot(lightSide, world);
}
