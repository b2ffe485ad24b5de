// What a scene, or the game that it stands for, may need of a technique. Entry::lacks states what a technique has no right
// answer for; advice (report/advice.h) leaves such techniques out.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

enum class Need {
    AnyReceiver,   // shadows fall on whatever is there, not on one plane alone
    AnyEye,        // the camera may be in a shadow and have casters behind it
    MovingLight,   // no shadow trails behind a light that moves
    MovingCasters, // the same of casters
    OpenMeshes,    // casters may be meshes that enclose no volume
    NoHistory,     // every frame is drawn without those before it
};

std::string_view name(Need need); // "any-receiver", "any-eye", …

std::string namesOf(const std::set<Need>& needs); // "any-eye, open-meshes"

/// Throws BadInput naming all and near matches.
Need needNamed(std::string_view name);

/// What is needed unless the user says otherwise: all but NoHistory.
const std::set<Need>& usualNeeds();

} // namespace shadowbench::techniques
