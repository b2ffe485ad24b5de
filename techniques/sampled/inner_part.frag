uniform sampler2D wide;
uniform int border;

out float visibility;

void main() {
    visibility = texelFetch(wide, ivec2(gl_FragCoord.xy) + border, 0).r;
}
