// What a scene is, seen with a stranger's eyes: its size, its meshes, its light, what the camera sees, and what is probably
// not as it was meant. Nothing is drawn or scored for it.
#pragma once

#include "base/image.h"
#include "harness/metrics/scores.h"
#include "scene/mesh_faults.h"
#include "scene/scene.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::inspect {

/// A mesh of the scene: a level of an object.
struct MeshReport {
    std::string name; // of the object, with the level where there are several
    std::size_t instances = 0;
    std::size_t triangles = 0;
    Bounds box; // of the first instance
    bool saidClosed = false;
    MeshFaults faults; // places are the mesh's own: before offset and place
};

/// What the pixels of the last still frame see. Lit, shadowed and penumbra are shares of receivers, by exact labels for some
/// points of the light: no point of it hidden, all, or some, so that there is at least this much penumbra. The others are
/// shares of all pixels.
struct FrameReport {
    glm::ivec2 size{0};
    int lightPoints = 0; // 0: an environment, of which there are no such labels
    double lit = 0, shadowed = 0, penumbra = 0;
    double receivers = 0, facesAway = 0, background = 0;
};

/// What is probably wrong, and what to do about it. Clauses, without a full stop.
struct Warning {
    std::string what, remedy;
};

struct Inspection {
    std::string scene, title;
    Profile profile = Profile::Gate;
    glm::dvec3 moved{0}; // Scene::moved
    Camera camera;
    Light light;
    Bounds box;         // of all that is there at the frame
    double toScene = 0; // metres from the eye to the box; 0 within
    int upAxis = 1;     // across which the largest flat surface lies: 0 x, 1 y, 2 z
    std::vector<MeshReport> meshes;
    FrameReport frame;
    std::optional<metrics::Aliasing> texels; // of a uniform map of 1024², under the light's centre
    std::vector<Warning> warnings;
    Image<glm::vec3> picture; // shaded, with soft shadows of the light's points, for a screen
};

/// Of the scene's last still frame.
Inspection inspect(const Scene& scene);

/// The warnings alone. Of the frame a coarse grid is looked at, and more only where all of it is lit or shadowed.
std::vector<Warning> warningsOf(const Scene& scene);

/// `warning: WHAT; REMEDY`
std::string lineOf(const Warning& warning);

/// A block of lines for a terminal, and a JSON object. `picture` is where the picture is; empty: nowhere.
std::string textOf(const Inspection& inspection, const std::string& picture);
std::string jsonOf(const Inspection& inspection, const std::string& picture);

} // namespace shadowbench::inspect
