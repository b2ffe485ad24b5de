in float casterDepth;

out vec2 moments;

void main() {
    moments = vec2(casterDepth, casterDepth * casterDepth);
}
