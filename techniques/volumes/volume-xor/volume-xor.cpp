// Stencil shadow volumes, exclusive-or (Zápotocký 2.4.5): every face of a volume's sides that passes the depth test inverts
// a pixel's stencil value, so that neither the order nor the direction of faces matters. Wrong, as the thesis says, where
// volumes overlap: an even number of them leaves a pixel lit, those of one mesh that hides parts of itself too; and where
// the eye is in a volume. Departure: depth is clamped (volume-zpass.cpp).
#include "techniques/contract/entry.h"
#include "techniques/volumes/counted_volumes.h"

namespace shadowbench::techniques {

Entry volumeXor() {
    return {.id = "volume-xor",
            .title = "Stencil shadow volumes, exclusive-or",
            .source = {Document::Zapotocky, "2.4.5"},
            .answer = Answer::Hard,
            .lacks = {Need::AnyEye, Need::OpenMeshes},
            .parameters = {},
            .figures = volumeFigures(),
            .variants = {""},
            .make = [](const Parameters&) { return std::make_unique<CountedVolumes>(VolumeTest::ExclusiveOr); }};
}

} // namespace shadowbench::techniques
