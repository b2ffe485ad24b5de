#include "filtered/basis.glsl"
#include "filtered/lvsm/layers.glsl"

uniform int layer;

out vec2 moments;

void main() {
    float depth = layerDepth(unitDepth(), layer);
    moments = vec2(depth, depth * depth);
}
