// Hamburger four-moment shadow mapping (Peters and Klein 2015): from the means of the first four powers of depth over a kernel, the least
// share of it that must lie before a receiver, and what is stored of them in 16 bits.

/// The first four powers of a depth in [0, 1].
vec4 powersOf(float depth) {
    float square = depth * depth;
    return vec4(depth, square, square * depth, square * square);
}

// The paper's affine transform (section 4.3): of the powers of all depths it makes numbers that fill [0, 1], so that 16 bits lose least.
// Column by column: what each power adds to the four numbers.
const mat4 quantisation = mat4(-2.07224649, 13.7948857237, 0.105877704, 9.7924062118,
                               32.23703778, -59.4683975703, -1.9077466311, -33.7652110555,
                               -68.571074599, 82.0359750338, 9.3496555107, 47.9456096605,
                               39.3703274134, -35.364903257, -6.6543490743, -23.9728048165);
const mat4 dequantisation = mat4(0.2227744146, 0.1549679261, 0.1451988946, 0.163127443,
                                 0.0771972861, 0.1394629426, 0.2120202157, 0.2591432266,
                                 0.7926986636, 0.7963415838, 0.7258694464, 0.6539092497,
                                 0.0319417555, -0.1722823173, -0.2758014811, -0.3376131734);
const vec4 quantisedZero = vec4(0.035955884801, 0.0, 0.0, 0.0);

vec4 quantised(vec4 powers) {
    return quantisation * powers + quantisedZero;
}

vec4 dequantised(vec4 numbers) {
    return dequantisation * (numbers - quantisedZero);
}

/// The share of depths < `depth`, at least, of a distribution with these moments (the paper's algorithm 3): that of the three depths of
/// which one is `depth`, and the others are roots of a polynomial that the moments' Hankel matrix gives. Moments are first moved by `bias`
/// towards those of an even choice of 0 and 1, so that rounding leaves the matrix positive.
float shadowedShare(vec4 moments, float depth, float bias) {
    vec4 b = mix(moments, vec4(0.5), bias);

    // B = L D Lᵀ of the matrix (1, b1, b2; b1, b2, b3; b2, b3, b4), and B c = (1, depth, depth²), times the last entry of D.
    float d2 = b.y - b.x * b.x;
    float l32 = (b.z - b.x * b.y) / d2;
    float d3 = b.w - b.y * b.y - l32 * l32 * d2;
    float y2 = depth - b.x;
    float c3 = depth * depth - b.y - l32 * y2;
    if (abs(c3) < 1e-20) c3 = 1e-20;  // one root is infinitely far
    float c2 = d3 * y2 / d2 - l32 * c3;
    float c1 = d3 - b.x * c2 - b.y * c3;

    float middle = -0.5 * c2 / c3;
    float spread = sqrt(max(middle * middle - c1 / c3, 0.0));
    float near = middle - spread, far = middle + spread;
    if (depth <= near) return 0.0;
    if (depth <= far) return (depth * far - b.x * (depth + far) + b.y) / ((far - near) * (depth - near));
    return 1.0 - (near * far - b.x * (near + far) + b.y) / ((depth - near) * (depth - far));
}

/// How far before a plane's own depth the bound still says that it is lit. `spread`: the change of its depth over half the kernel along
/// x and y. The kernel holds the sum of two even distributions; moments give of such two depths beside the middle one, this far away.
float reachOfPlane(vec2 spread) {
    vec2 squares = spread * spread;
    float second = (squares.x + squares.y) / 3.0, fourth = dot(squares, squares) / 5.0 + 2.0 / 3.0 * squares.x * squares.y;
    return second > 0.0 ? sqrt(fourth / second) : 0.0;
}
