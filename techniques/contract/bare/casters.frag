// The depth as a colour: of what a caster's fragment may write, the least.
out vec4 value;

void main() {
    value = vec4(gl_FragCoord.z);
}
