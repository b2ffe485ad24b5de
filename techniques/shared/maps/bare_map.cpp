#include "techniques/shared/maps/bare_map.h"

namespace shadowbench::techniques {

std::vector<BarePass> bareMappedShadow(const Frame& frame, const LightView& light, int side, MapReads reads) {
    const Taps taps{gl::Format::Depth32F, glm::ivec2(side), reads.read, reads.count};
    return {bareDepthMap("course, Shadow Mapping", side, light.clipFromWorld),
            bareLookup(reads.lookup, std::move(reads.source), frame.size, {taps})};
}

} // namespace shadowbench::techniques
