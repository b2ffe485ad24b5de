flat in uint id;

layout(location = 0) out uint instanceInTransition;

void main() {
    instanceInTransition = id;
}
