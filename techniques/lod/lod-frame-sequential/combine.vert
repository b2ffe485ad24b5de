// Rectangles of the screen, two triangles each.
const int most = 256;
uniform vec4 rectangles[most];  // left, bottom, right, top

void main() {
    vec4 rectangle = rectangles[gl_VertexID / 6];
    int corner = gl_VertexID % 6;  // left bottom, right bottom, right top; left bottom, right top, left top
    bool right = corner == 1 || corner == 2 || corner == 4, top = corner == 2 || corner > 3;
    gl_Position = vec4(right ? rectangle.z : rectangle.x, top ? rectangle.w : rectangle.y, 0.0, 1.0);
}
