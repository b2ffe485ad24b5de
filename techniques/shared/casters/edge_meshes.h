// The edges of all meshes that a technique has met.
#pragma once

#include "techniques/shared/casters/shadow_volume.h"

#include <memory>
#include <unordered_map>

namespace shadowbench::techniques {

class EdgeMeshes {
public:
    /// Found when the mesh is met first; the mesh is kept alive.
    const EdgeMesh& of(const std::shared_ptr<const Mesh>& mesh) {
        auto& entry = met_[mesh.get()];
        if (!entry) entry = std::make_unique<Met>(mesh);
        return entry->edges;
    }

private:
    struct Met {
        explicit Met(std::shared_ptr<const Mesh> mesh) : source(std::move(mesh)), edges(*source) {}
        std::shared_ptr<const Mesh> source;
        EdgeMesh edges;
    };
    std::unordered_map<const Mesh*, std::unique_ptr<Met>> met_;
};

} // namespace shadowbench::techniques
