// Second surface: the nearest of what the depth test leaves behind the first one. The first surface is the same fragment to the last bit, so
// that equality peels exactly it. Occluders before the near plane lie at depth 0, as in the first map.
out float depth;

void main() {
    depth = max(gl_FragCoord.z, 0.0);
}
