// A shadow volume's vertex: at its place (w = 1), or projected to infinity away from the light (w = 0).
layout(location = 0) in vec4 vertex;
layout(location = 1) in vec4 worldRow0;
layout(location = 2) in vec4 worldRow1;
layout(location = 3) in vec4 worldRow2;

invariant gl_Position;

uniform mat4 clipFromWorld;
uniform vec4 light;  // homogeneous

void main() {
    // The same expression as gl/instance.glsl, so that the front cap covers the pixels of the surface it lies on.
    vec4 p = vec4(vertex.xyz, 1.0);
    vec3 world = vec3(dot(worldRow0, p), dot(worldRow1, p), dot(worldRow2, p));
    gl_Position = vertex.w > 0.5 ? clipFromWorld * vec4(world, 1.0) : clipFromWorld * vec4(world * light.w - light.xyz, 0.0);
}
