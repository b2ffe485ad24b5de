// Runs where the stencil count is not zero: inside a shadow volume.
out float visibility;

void main() {
    visibility = 0.0;
}
