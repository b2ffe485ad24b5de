in float linearDepth;
flat in uint moving;

uniform vec2 bias;  // slope factor, constant in metres

out float stored;

void main() {
    float slope = max(abs(dFdx(linearDepth)), abs(dFdy(linearDepth)));
    float depth = linearDepth + bias.x * slope + bias.y;
    stored = moving != 0u ? -depth : depth;
}
