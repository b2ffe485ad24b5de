// Bilinear reads that a lookup takes: two of a place between two mipmaps.
#include "filtered/prefiltered_map.glsl"

out float reads;

void main() {
    FilteredReceiver r = filteredReceiver();
    reads = r.known ? float(r.probes) * (fract(r.level) > 0.0 ? 2.0 : 1.0) : 0.0;
}
