// Values on their way into 16-bit float textures. Drivers may convert by truncation (llvmpipe does), so that a value written, read
// bilinearly a hair beside its centre and written again loses a step every frame. A quarter to a half step more makes truncation round
// to nearest; a value that has 16 bits already comes out as it went in.
const float halfStep = 1.0 + 1.0 / 4096.0;

vec2 toHalf(vec2 value) {
    return value * halfStep;
}

vec4 toHalf(vec4 value) {
    return value * halfStep;
}
