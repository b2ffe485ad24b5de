// Vertex input of every pass that draws the scene (gl/scene_buffers.h). One expression for the world position, and an invariant
// gl_Position, so that passes of the same camera agree on depth to the last bit.
layout(location = 0) in vec3 objectPosition;
layout(location = 1) in vec4 worldRow0;
layout(location = 2) in vec4 worldRow1;
layout(location = 3) in vec4 worldRow2;
layout(location = 4) in vec4 previousRow0;
layout(location = 5) in vec4 previousRow1;
layout(location = 6) in vec4 previousRow2;
layout(location = 7) in uvec2 idAndMoving;
layout(location = 8) in vec3 previousObjectPosition;

invariant gl_Position;

vec3 worldPosition(vec3 position) {
    vec4 p = vec4(position, 1.0);
    return vec3(dot(worldRow0, p), dot(worldRow1, p), dot(worldRow2, p));
}

vec3 previousWorldPosition(vec3 position) {
    vec4 p = vec4(position, 1.0);
    return vec3(dot(previousRow0, p), dot(previousRow1, p), dot(previousRow2, p));
}
