// The surface point that a pixel sees, from the G-buffer.
uniform sampler2D positions;

struct Receiver {
    vec3 position;  // world
    bool seen;      // false: background
};

Receiver receiverAt(vec2 fragCoord) {
    vec4 p = texelFetch(positions, ivec2(fragCoord), 0);
    return Receiver(p.xyz, p.w > 0.5);
}
