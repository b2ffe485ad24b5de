// The plane that planar shadows fall on, and Blinn's projection onto it (Zápotocký 2.2). No GL.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace shadowbench::techniques {

/// A flat face of one placement.
struct PlanarReceiver {
    std::uint32_t id = 0;            // the placement's
    glm::dvec4 plane{0};             // unit normal towards the light; dot(plane, (p, 1)) = metres above the plane
    std::vector<glm::dvec3> corners; // of the face's triangles, in the world
};

/// The largest flat face (two triangles or more) that the light's centre is in front of, with the middle of every other
/// placement; nothing if there is none.
std::optional<PlanarReceiver> planarReceiver(const Snapshot& snapshot);

/// The same for frame after frame: the flat faces of each mesh are found once.
class ReceiverFinder {
public:
    std::optional<PlanarReceiver> find(const Snapshot& snapshot, const Light& hardLight);

    /// Triangles of a mesh in one plane.
    struct FlatFace {
        std::vector<std::uint32_t> triangles;
        glm::dvec3 area{0}; // sum of the triangles' normals, each as long as its area
    };

private:
    struct MeshFaces {
        std::shared_ptr<const Mesh> source; // keeps the key alive
        std::vector<FlatFace> faces;
    };
    struct Candidate;

    std::vector<Candidate> facesTowardsLight(const Snapshot& snapshot, const glm::dvec4& light) const;

    std::unordered_map<const Mesh*, MeshFaces> meshes_;
};

/// Why planar shadows do not apply to a scene; nothing if they do.
std::optional<std::string> noPlanarReceiver(const Scene& scene);

/// Projection of the world onto `plane` away from the homogeneous `light` (eq. 2.3, for column vectors). w is positive for
/// points that are nearer to the plane than the light is.
glm::dmat4 projectionOnto(const glm::dvec4& plane, const glm::dvec4& light);

} // namespace shadowbench::techniques
