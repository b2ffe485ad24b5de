#include "techniques/catalog.h"

#include <array>

namespace shadowbench::techniques {

#define TECHNIQUE(name) Entry name();
#include "techniques/catalog.inc"
#undef TECHNIQUE

std::span<const Entry> catalog() {
    static const std::array entries{
#define TECHNIQUE(name) name(),
#include "techniques/catalog.inc"
#undef TECHNIQUE
    };
    return entries;
}

} // namespace shadowbench::techniques
