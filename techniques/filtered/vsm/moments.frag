#include "filtered/basis.glsl"

out vec2 moments;

void main() {
    float depth = unitDepth();
    moments = vec2(depth, depth * depth);
}
