// What of a scene's casters changes from frame to frame (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

class CasterChanges {
public:
    /// World corners of the bounding boxes, eight each, of the placements that have moved or changed their mesh since the
    /// last call, where they were and where they are. Nothing if placements have come or gone, and at the first call.
    std::optional<std::vector<glm::dvec3>> since(const Snapshot& snapshot);

    /// Makes the next call the first.
    void forget() { casters_.reset(); }

private:
    struct Caster {
        std::shared_ptr<const Mesh> mesh; // kept, so that no other mesh gets its address
        glm::dmat4 world;
    };
    std::optional<std::map<std::uint32_t, Caster>> casters_; // by Placement::id
};

} // namespace shadowbench::techniques
