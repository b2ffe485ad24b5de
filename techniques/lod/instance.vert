// Vertex input of every pass that draws instances at a level (lod/level_drawer.h).
layout(location = 0) in vec3 objectPosition;
layout(location = 1) in vec4 worldRow0;
layout(location = 2) in vec4 worldRow1;
layout(location = 3) in vec4 worldRow2;
layout(location = 4) in vec4 colourAndVisibility;
layout(location = 5) in uint instanceId;

uniform mat4 clipFromWorld;

invariant gl_Position;
out vec3 world;
out vec3 object;  // before any animation
flat out vec3 surfaceColour;
flat out float visibility;
flat out uint id;

void main() {
    vec4 p = vec4(objectPosition, 1.0);
    object = objectPosition;
    world = vec3(dot(worldRow0, p), dot(worldRow1, p), dot(worldRow2, p));
    surfaceColour = colourAndVisibility.rgb;
    visibility = colourAndVisibility.a;
    id = instanceId;
    gl_Position = clipFromWorld * vec4(world, 1.0);
}
