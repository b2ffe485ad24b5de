out float width;

void main() {
    width = 0.5;
}
