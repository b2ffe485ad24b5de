// The frame in which light and casters move: the shown one once more, after a frame in which both were elsewhere. So it
// draws what the standing frame draws, and what it costs beside that is what a technique had kept from frame to frame.
//
// The rule is one for all scenes and looks at nothing but their size: a light with a position and all surfaces are shifted
// by a hundredth of the scene's diameter along x, surfaces of even ids to the other side, so that neighbours move against
// each other; directions (of a light, of the suns of a sky) turn by a hundredth of a radian; a sky's radiance grows by a
// hundredth. The camera stands.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/entry.h"

namespace shadowbench {

/// What moves beside the light.
enum class Casters { Stand, Move };

/// Casters move unless the technique, which applies to the scene, refuses one whose surfaces move (precomputed radiance
/// transfer): then the light moves alone.
Casters castersUnder(const techniques::Entry& entry, const Scene& scene);

/// Light and casters elsewhere, where they have come from `standing`.
Snapshot displaced(const Snapshot& standing, Casters casters);

/// Where they have come from `displaced(standing, casters)`.
Snapshot returned(const Snapshot& standing, Casters casters);

} // namespace shadowbench
