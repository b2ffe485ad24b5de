// Floats as numbers that an atomicMax can compare.

/// A number above 0 that is greater for a greater float.
uint ordered(float x) {
    uint bits = floatBitsToUint(x);
    return bits ^ ((bits & 0x80000000u) != 0u ? 0xffffffffu : 0x80000000u);
}

/// And back.
float unordered(uint code) {
    return uintBitsToFloat(code ^ ((code & 0x80000000u) != 0u ? 0x80000000u : 0xffffffffu));
}
