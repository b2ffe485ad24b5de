layout(std430, binding = 5) readonly buffer Shadows { uint shadows[]; };

uniform int width;

out float visibility;

void main() {
    visibility = shadows[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)] == 0u ? 1.0 : 0.0;
}
