uniform vec4 sliceEnds[TILES];  // x: eye depth at which slice i ends, y: at which the next slice's map begins to take over

/// The slice that holds an eye depth; the last also holds what lies behind it: sliceOf() of shared/light_views/cascades.h.
int sliceOf(float depth) {
    int slice = 0;
    while (slice < TILES - 1 && depth > sliceEnds[slice].x) ++slice;
    return slice;
}

/// Weight of the next slice's map at a depth within `slice`: it grows evenly to 1 at the slice's end. The last has no next.
float nextWeight(int slice, float depth) {
    if (slice == TILES - 1) return 0.0;
    vec4 end = sliceEnds[slice];
    return clamp((depth - end.y) / (end.x - end.y), 0.0, 1.0);
}
