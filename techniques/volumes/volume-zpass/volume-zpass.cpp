// Stencil shadow volumes, depth-pass (Heidmann; Zápotocký 2.4.3; course, Everitt–Kilgard 2.2). Front faces of a volume's
// sides that pass the depth test increment, back faces decrement, both in one pass with wrapping two-sided stencil. Wrong,
// as the papers say, wherever the eye is in a volume: the count then lacks that volume. Models are closed: an open one
// throws shadows where its triangles face the light, and none where they turn their backs to it. Departures: depth is
// clamped, so that the eye's own place decides and not the near plane's, which clips volumes of casters close to it open;
// and at most 255 placements are counted together (volume-zfail.cpp).
#include "techniques/contract/entry.h"
#include "techniques/volumes/counted_volumes.h"

namespace shadowbench::techniques {

Entry volumeZpass() {
    return {.id = "volume-zpass",
            .title = "Stencil shadow volumes, depth-pass",
            .source = {Document::Zapotocky, "2.4.3; course, Practical and Robust Stenciled Shadow Volumes, 2.2"},
            .answer = Answer::Hard,
            .lacks = {Need::AnyEye, Need::OpenMeshes},
            .parameters = {},
            .figures = volumeFigures(),
            .variants = {""},
            .make = [](const Parameters&) { return std::make_unique<CountedVolumes>(VolumeTest::DepthPass); }};
}

} // namespace shadowbench::techniques
