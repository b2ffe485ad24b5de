in float linearDepth;
flat in uint surface;

uniform vec2 bias;  // slope factor, constant in metres

out vec2 stored;

void main() {
    float slope = max(abs(dFdx(linearDepth)), abs(dFdy(linearDepth)));
    stored = vec2(linearDepth + bias.x * slope + bias.y, float(surface));
}
