// The uniforms that a technique folder's shaders may declare; the program sets those that they use.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/depth_map.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

struct FolderState {
    const Frame& frame;
    const LightView& view;
    int historyFrames; // drawn since the history was forgotten
    int repetition;    // of the pass or its group, from 0
    Bias bias;         // of the parameters of a depth map
    bool followsPlane; // techniques/shared/maps/depth_map.h
    glm::ivec2 mapSize;
};

struct FolderInput {
    std::string_view name;
    std::string_view type;
    std::string_view meaning;
    void (*set)(gl::Program&, const std::string& name, const FolderState&);
};

/// All but the targets, which are samplers by their names.
std::span<const FolderInput> folderInputs();

} // namespace shadowbench::techniques
