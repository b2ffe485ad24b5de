// An edge of a caster (techniques/volumes/penumbra_wedges.h).
struct Edge {
    vec4 from, to;     // world; from.w: its layers, to.w: those of a triangle that does not face the light, 0 or −1
    vec4 left, right;  // planes of the triangles on either side, (n, d) of n · x + d = 0; 0 where there is none
};
