void main() {}  // depth only
