// Terms 2 layer + 1 and 2 layer + 2: cosine and sine of each, brought from [−1, 1] to [0, 1].
#include "filtered/basis.glsl"

uniform int layer;
uniform float usedDepth;

out vec4 stored;

const float pi = 3.14159265358979;

void main() {
    float first = pi * float(4 * layer + 1) * usedDepth * unitDepth();  // c_k = π (2k − 1)
    float second = pi * float(4 * layer + 3) * usedDepth * unitDepth();
    stored = 0.5 + 0.5 * vec4(cos(first), sin(first), cos(second), sin(second));
}
