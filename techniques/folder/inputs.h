// The uniforms that a technique folder's shaders may declare; the program sets those that they use.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/cascade_fit.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "techniques/shared/maps/depth_map.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

struct FolderState {
    const Frame& frame;
    std::span<const LightView> views; // that are drawn into, or read
    std::span<const Tile> tiles;      // of the first map, one for each of the light's views
    glm::ivec2 mapSize;               // of the first map
    const CascadeFit* cascades;       // of a folder that has them
    int historyFrames;                // drawn since the history was forgotten
    int repetition;                   // of the pass or its group, from 0
    Bias bias;                        // of the parameters of a depth map
    bool followsPlane;                // techniques/shared/maps/depth_map.h
    bool addsUnits;                   // to depths that are made linear: they are drawn without
};

/// What an input changes with, beside light and casters.
enum class InputOf {
    Light,    // nothing else
    EachView, // nothing else; where there are several views, an array of as many
    Frame     // camera, motion or time
};

struct FolderInput {
    std::string_view name;
    std::string_view type;
    std::string_view meaning;
    void (*set)(gl::Program&, const std::string& name, const FolderState&);
    InputOf of = InputOf::Light;
};

/// All but the targets, which are samplers by their names.
std::span<const FolderInput> folderInputs();

} // namespace shadowbench::techniques
