// How a pass of a technique folder draws: blending, faces that are left out, depth test and stencil.
#pragma once

#include "techniques/folder/description.h"

namespace shadowbench::techniques {

/// As the pass says, as long as it lives; everything else draws without. Of a pass that draws casters it begins after what
/// sets the depth test of all of them.
class DrawState {
public:
    explicit DrawState(const FolderPass& pass);
    ~DrawState();
    DrawState(const DrawState&) = delete;
    DrawState& operator=(const DrawState&) = delete;

private:
    bool blends_, culls_, peels_, hasStencil_;
};

} // namespace shadowbench::techniques
