#include "scene/exchange/parts.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::exchange {
namespace {

/// OBJ ends a name at a blank, and other programs rename what they cannot write.
std::string plain(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
        result += kept ? c : '_';
    }
    return result.empty() ? "object" : result;
}

} // namespace

Parts::Parts(const Scene& scene) {
    std::uint32_t id = 0;
    for (const Object& object : scene.objects) {
        const std::string name = plain(object.name);
        for (std::size_t i = 0; i < object.levels.size(); ++i)
            add(object.levels[i].mesh, object.shown(i),
                object.levels.size() == 1 ? name : fmt::format("{}-level{}", name, i));
        for (std::size_t i = 1; i < object.poses.size(); ++i)
            add(object.poses[i], object.shown(0), fmt::format("{}-pose{}", name, i));
        for (std::size_t i = 0; i < object.instances.size(); ++i) instanceNames_.push_back(fmt::format("{}-{}", name, ++id));
    }
}

void Parts::add(const std::shared_ptr<const Mesh>& mesh, const glm::vec3& colour, const std::string& name) {
    const auto [known, isNew] = index_.try_emplace({mesh.get(), colour.x, colour.y, colour.z}, list_.size());
    if (isNew) list_.push_back({names_.add(name), mesh, colour});
}

std::size_t Parts::indexOf(const Mesh* mesh, const glm::vec3& colour) const {
    return index_.at({mesh, colour.x, colour.y, colour.z});
}

std::vector<Node> nodesOf(const Snapshot& frame, const Parts& parts) {
    std::vector<Node> nodes;
    for (const Batch& batch : frame.batches)
        for (const Placement& placement : batch.placements)
            nodes.push_back({&placement, parts.indexOf(batch.mesh.get(), batch.colour)});
    std::ranges::sort(nodes, {}, [](const Node& node) { return node.placement->id; });
    return nodes;
}

} // namespace shadowbench::exchange
