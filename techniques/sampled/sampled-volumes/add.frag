// One light sample's image, to be added to those of the others.
uniform sampler2D lit;

out float sum;

void main() {
    sum = texelFetch(lit, ivec2(gl_FragCoord.xy), 0).r;
}
