// Weights of a neighbourhood of 17 × 17 pixels along one side, to be divided by their sum.
const int radius = 8;

float weightAt(int distance) {
    return exp(-3.0 * float(distance * distance) / float((radius + 1) * (radius + 1)));
}
