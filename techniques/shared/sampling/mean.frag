uniform sampler2D sum;
uniform float count;

out float visibility;

void main() {
    visibility = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).r / count;
}
