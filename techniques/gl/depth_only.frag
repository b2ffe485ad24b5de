// For passes that draw depth alone.
void main() {}
