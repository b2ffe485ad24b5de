// A glTF file's JSON and the numbers in its buffers, in the child that reads meshes.
#pragma once

#include "scene/meshes/foreign_mesh.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace shadowbench {

using GltfJson = nlohmann::json;

/// The numbers of an accessor: `count` elements, `stride` bytes from one to the next.
struct GltfElements {
    const char* first;
    std::size_t count, stride;
    int component;
};

inline constexpr int kGltfFloat = 5126; // glTF's number for the type of a component

std::size_t sizeOfComponent(int component);

/// The list that `object` has under `name`; an empty one where it has none.
const GltfJson& gltfList(const GltfJson& object, const char* name);

std::size_t gltfWhole(const GltfJson& object, const char* name, std::size_t otherwise);

/// Its members throw BadInput, without a file's name, and the errors of nlohmann's JSON.
class GltfBuffers {
public:
    /// `file` must outlive it.
    explicit GltfBuffers(const ForeignMeshFile& file);

    [[nodiscard]] const GltfJson& json() const { return json_; }

    [[nodiscard]] const GltfJson& entry(const char* list, std::size_t index) const;

    /// `type`: of an element, "SCALAR", "VEC2" or "VEC3".
    GltfElements elements(std::size_t accessor, std::string_view type);

    /// The bytes of images[index].
    std::string image(std::size_t index);

private:
    std::string_view bytesOf(std::size_t buffer);
    std::string_view bytesOfView(std::size_t view);
    [[nodiscard]] std::string_view handed(const std::string& uri) const;

    const ForeignMeshFile& file_;
    std::string_view binary_; // of a .glb
    GltfJson json_;
    std::map<std::size_t, std::string> decoded_; // buffers that are in the JSON, by number
};

} // namespace shadowbench
