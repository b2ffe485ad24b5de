uniform sampler2D mean;

out float visibility;

void main() {
    visibility = texelFetch(mean, ivec2(gl_FragCoord.xy), 0).r;
}
