// What the files of an exported scene have in common: its meshes and instances, by name.
#pragma once

#include "scene/gltf_file.h"
#include "scene/scene.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace shadowbench::exchange {

/// A mesh in one colour: a mesh of glTF, a group of OBJ.
struct Part {
    std::string name;
    std::shared_ptr<const Mesh> mesh;
    glm::vec3 colour;
};

/// All levels of detail and poses of all objects, whether a scored frame shows them or not, and all instances. Names have
/// letters, digits, '.', '_' and '-', and are not empty.
class Parts {
public:
    explicit Parts(const Scene& scene);

    [[nodiscard]] const std::vector<Part>& list() const { return list_; }
    [[nodiscard]] std::size_t indexOf(const Mesh* mesh, const glm::vec3& colour) const;
    [[nodiscard]] const std::string& nameOf(const Mesh* mesh, const glm::vec3& colour) const {
        return list_[indexOf(mesh, colour)].name;
    }

    /// Of the instance with this id, Placement::id.
    [[nodiscard]] const std::string& instanceName(std::uint32_t id) const { return instanceNames_.at(id - 1); }

private:
    void add(const std::shared_ptr<const Mesh>& mesh, const glm::vec3& colour, const std::string& name);

    using Key = std::tuple<const Mesh*, float, float, float>;
    std::vector<Part> list_;
    std::map<Key, std::size_t> index_;
    UniqueNames names_; // of list_
    std::vector<std::string> instanceNames_;
};

/// An instance in a snapshot, with the mesh that its distance chooses.
struct Node {
    const Placement* placement;
    std::size_t part;
};

/// All instances of `frame`, in the order of their ids.
std::vector<Node> nodesOf(const Snapshot& frame, const Parts& parts);

} // namespace shadowbench::exchange
