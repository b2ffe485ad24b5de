uniform sampler2D source;

out float visibility;

void main() {
    visibility = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r;
}
