#include "gl/instance.glsl"

uniform mat4 clipFromWorld;

void main() {
    gl_Position = clipFromWorld * vec4(worldPosition(objectPosition), 1.0);
}
