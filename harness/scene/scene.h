// The scene model. A Scene is data (loaded from TOML); a Snapshot is the scene at one frame: what techniques draw and what
// the ground truth is computed for.
#pragma once

#include "harness/scene/camera.h"
#include "harness/scene/mesh.h"

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

enum class Profile { Gate, Standard, Paper };
std::string_view name(Profile profile);
Profile profileNamed(std::string_view name); // throws BadInput naming the valid ones

/// Key frames of a vector quantity: linear between them, constant outside; empty means "the rest value". Frames count from
/// the last still frame of the timeline: everything is at rest before.
struct Track {
    struct Key {
        double frame;
        glm::dvec3 value;
    };
    std::vector<Key> keys; // ascending frames

    [[nodiscard]] glm::dvec3 at(double frame, const glm::dvec3& rest) const;
};

/// How all instances of an object move: a turn about an object-space axis through the object's origin and a shift in the
/// world.
struct Motion {
    glm::dvec3 axis{0, 0, 1};   // unit length
    double degreesPerFrame = 0; // of turn; an instance starts at its own phase
    Track shift;                // metres, added to the instance's place

    [[nodiscard]] bool still() const { return degreesPerFrame == 0 && shift.keys.empty(); }
};

/// One placement of an object: world from object, and the turn (degrees about Motion::axis) it starts with.
struct Instance {
    glm::dmat4 place{1};
    double phase = 0;
};

/// A level of detail: used from the previous level's `until` up to this one's (metres between eye and instance origin).
struct Level {
    std::shared_ptr<const Mesh> mesh;
    double until = std::numeric_limits<double>::infinity();
    std::optional<glm::vec3> colour{}; // instead of the object's, in pictures and for level-of-detail techniques
};

struct Object {
    std::string name;
    glm::vec3 colour{0.8F};
    std::vector<Level> levels; // finest first, never empty
    std::vector<Instance> instances;
    Motion motion;
};

/// The frames a cell renders: `still` ones with everything at rest (history techniques converge over them; the last is the
/// one that accuracy is scored on), then `moving` ones along the tracks (stability is scored on them).
struct Timeline {
    int still = 60;
    int moving = 8;
    [[nodiscard]] int frames() const { return still + moving; }
};

/// The walk that level-of-detail techniques are scored on: a camera path along which instances change levels. Motions of
/// objects start with it. Shadows are scored on the Timeline, not here.
struct LodWalk {
    int frames = 2;
    double band = 0.2; // length of a transition as a share of the distance in its middle, Level::until
    Track eye, target; // of the camera, by the walk's frames
};

/// What a scene is there to show of one technique: a bound on one metric.
struct Expectation {
    std::string technique; // a variant; may name a technique that the catalogue does not have yet
    std::string metric;    // one that `tolerance` may name
    double bound = 0;      // of an expected failure: the metric lies above; of a technique that holds: below
    std::string reason;
};

/// Where a technique's error over one axis of `sweep` (harness/sweep/axis.h) first exceeds the scene's tolerance, in the
/// order of the axis' own values.
struct BreakExpectation {
    std::string technique; // a variant; without the axis where that is one of its parameters
    std::string axis;
    std::optional<glm::dvec2> between; // the break point, ends included, x ≤ y; nothing: the whole axis is tolerated
    std::string reason;
};

struct Scene {
    std::string id; // file stem: the one word for it everywhere
    std::string title;
    std::string shows; // what the scene is there to show: the file's first comment
    Profile profile = Profile::Gate;
    glm::ivec2 size{256, 256};
    Timeline timeline;
    Camera camera;
    Track eye, target; // of the camera
    Light light;
    Track lightCentre, lightDirection;
    std::vector<Object> objects;
    std::optional<LodWalk> lod;
    std::map<std::string, double> tolerance; // metric name → worst value a viewer of this scene accepts
    std::vector<Expectation> fails;          // techniques that the scene breaks: one that stops failing is an error too
    std::vector<Expectation> holds;          // techniques that it does not break
    std::vector<BreakExpectation> breaks;    // where techniques break as one of its quantities moves
    int referenceSamples = 1024;             // light samples of an area light's reference on the scored frame …
    int movingReferenceSamples = 256;        // … and on the moving frames
};

/// One drawn instance at one frame.
struct Placement {
    glm::dmat4 world;    // affine, world from object
    glm::dmat4 previous; // the same one frame earlier (equal to `world` in frame 0)
    std::uint32_t
        id; // surface id: the instance's number in the scene, from 1; 0 is background. Stable over frames and levels
};

/// All placements of one mesh.
struct Batch {
    std::shared_ptr<const Mesh> mesh;
    glm::vec3 colour;
    bool moving; // some placement differs from its previous one
    std::vector<Placement> placements;
};

struct Snapshot {
    int frame = 0;
    Camera camera, previousCamera;
    Light light;
    std::vector<Batch> batches;

    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] std::size_t triangles() const;
};

/// World from object of an instance after `frames` frames of its object's motion.
glm::dmat4 placeAt(const Object& object, const Instance& instance, double frames);

/// The scene at `frame`; levels of detail chosen by distance from the eye.
Snapshot snapshot(const Scene& scene, int frame);

/// Loads a built-in scene by id or a file by path. Errors (BadInput) name file, line and key, and near matches for an
/// unknown id.
Scene loadScene(const std::string& idOrFile, Profile profile);

/// Parses TOML text; `file` is used for the id, for error messages and to resolve mesh files.
Scene parseScene(std::string_view toml, const std::filesystem::path& file, Profile profile);

/// Ids of the five standard scenes, in the order tables print them: what a run without `--scene` renders.
std::vector<std::string> standardScenes();

/// Ids of all built-in scenes, the standard ones first, and the text of one.
std::vector<std::string> builtinScenes();
std::string_view builtinSceneText(const std::string& id);

/// Throws BadInput when the set-up has no defined answer: light on a surface, zero-size area light, eye inside a closed
/// mesh.
void requireSound(const Scene& scene);

} // namespace shadowbench
