// What filtering has taken of the contrast is given back where no variance is left.
uniform sampler2D source;

out float visibility;

void main() {
    vec2 filtered = texelFetch(source, ivec2(gl_FragCoord.xy), 0).rg;
    visibility = pow(filtered.r, max(CONTRAST - filtered.g, 1.0));
}
