#include "filtered/basis.glsl"

uniform float c;

out float stored;

void main() {
    stored = exp(c * unitDepth());
}
