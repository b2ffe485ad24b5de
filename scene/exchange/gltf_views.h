// The cameras and lights of a glTF file as those of a scene file. Only sources of this folder include this.
#pragma once

#include "scene/exchange/gltf_document.h"
#include "scene/gltf_file.h"
#include "scene/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::exchange {

/// A camera or a light of the file.
struct GltfView {
    std::string name; // its own or its node's, made unique
    toml::table keys; // of `camera` or `light` in a scene file
    double aspect = 1;
    bool endless = false;  // a camera without zfar, whose keys lack `far`
    bool isAimed = true;   // else a camera's `target` is no more than a point before it
    std::string refusal{}; // why a scene cannot have it, and what to write instead
};

/// What nodes hold of one kind, in their order.
class GltfViews {
public:
    explicit GltfViews(std::string kind) : kind_(std::move(kind)) {} // "camera" or "light"

    void add(GltfView view, const std::string& node);

    [[nodiscard]] bool empty() const { return views_.empty(); }

    /// The one of that name, or the only one; there must be some. Throws BadInput, with the names, where no choice is left
    /// or the chosen one is refused.
    [[nodiscard]] const GltfView& chosen(const std::optional<std::string>& name, const std::string& file) const;

private:
    [[nodiscard]] std::string names() const;

    std::string kind_;
    std::vector<GltfView> views_;
    UniqueNames taken_;
};

/// `metres`: of the file's unit. What our exporter has written of a camera or a light is taken as it is where `exact`.
GltfView cameraOf(const Json& camera, const glm::dmat4& world, double metres, bool exact);
GltfView lightOf(const Json& light, const glm::dmat4& world, bool exact);

/// Lines of a scene file that show all of `box`, for the user to start from.
std::string exampleCamera(const Bounds& box);
std::string exampleLight();

} // namespace shadowbench::exchange
