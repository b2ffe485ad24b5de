uniform vec4 sliceEnds[TILES];  // x: eye depth at which slice i ends

/// The slice that holds an eye depth; the last also holds what lies behind it: sliceOf() of shared/light_views/cascades.h.
int sliceOf(float depth) {
    int slice = 0;
    while (slice < TILES - 1 && depth > sliceEnds[slice].x) ++slice;
    return slice;
}
