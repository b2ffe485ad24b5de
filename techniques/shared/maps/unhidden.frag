// One word a pixel: whether a triangle hides the light from it.
layout(std430, binding = 5) readonly buffer Results { uint results[]; };

uniform int width;

out float visibility;

void main() {
    visibility = results[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)] == 0u ? 1.0 : 0.0;
}
