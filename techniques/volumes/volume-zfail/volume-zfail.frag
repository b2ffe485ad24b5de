// Runs where the stencil count is zero: outside all shadow volumes.
out float visibility;

void main() {
    visibility = 1.0;
}
