// Stencil shadow volumes, ZP+ (Hornus, Hoberock, Lefebvre, Hart 2005): depth-pass that is right wherever the eye is.
// Depth-pass lacks the volumes in which a pixel's ray begins, on the near plane. 1. the light looks through the near plane's
// window at what lies between: an image with the same pixels, in which each triangle that faces the light adds one to the
// stencil
// 2. the sides of the volumes are counted by depth-pass, and clipped by the near plane as ever. Nothing is drawn at
// infinity, so that sheets may be open, if they face the light. Where the near plane cuts a side, the last pixels of the
// side and of its cap are rasterised from different vertices: a stray pixel along the cut is counted twice or not at all.
// Departures: the light's view is one matrix, which projects onto the near plane and then as the camera does, in place of a
// frustum with the window as its far plane: the same pixels; only casters whose volumes may meet the near plane are drawn
// there; and at most 255 placements are counted together (volume-zfail.cpp).
#include "techniques/contract/entry.h"
#include "techniques/volumes/counted_volumes.h"

namespace shadowbench::techniques {

Entry smZpp() {
    return {.id = "sm-zpp",
            .title = "Stencil shadow volumes, depth-pass from the near plane on (ZP+)",
            .source = {Document::Other, "Hornus et al. 2005"},
            .answer = Answer::Hard,
            .lacks = {Need::OpenMeshes},
            .parameters = {},
            .figures = volumeFigures(),
            .variants = {""},
            .make = [](const Parameters&) { return std::make_unique<CountedVolumes>(VolumeTest::NearPlane); }};
}

} // namespace shadowbench::techniques
