// What a pixel sees of one part of the light, to be added to the others: the V-buffer's value, where no more is hidden than there is.
uniform sampler2D hidden;

out float visible;

void main() {
    visible = clamp(1.0 - texelFetch(hidden, ivec2(gl_FragCoord.xy), 0).r, 0.0, 1.0);
}
