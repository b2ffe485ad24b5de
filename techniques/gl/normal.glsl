// The unit normal of the surface that a pixel sees, from the G-buffer.
uniform sampler2D normals;

vec3 normalAt(vec2 fragCoord) {
    return normalize(texelFetch(normals, ivec2(fragCoord), 0).xyz);
}
