// The scene model: data, loaded from a scene file, of which `snapshot` makes what is there at one frame.
#pragma once

#include "scene/camera.h"
#include "scene/mesh.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <functional>
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
const std::vector<std::string>& profileNames();

/// Key frames of a vector quantity: linear between them, constant outside; empty means "the rest value". Frames count from
/// the last still frame of the timeline: everything is at rest before, but for a camera that approaches
/// (Timeline::approach), whose frames before the first still one are negative.
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

/// One placement of an object: world from object, the turn (degrees about Motion::axis) and the pose it starts with.
struct Instance {
    glm::dmat4 place{1};
    double phase = 0;
    int pose = 0;
};

/// A level of detail: used from the previous level's `until` up to this one's (metres between eye and instance origin).
struct Level {
    std::shared_ptr<const Mesh> mesh;
    double until = std::numeric_limits<double>::infinity();
    std::optional<glm::vec3> colour{}; // instead of the object's, in pictures and for level-of-detail techniques
    std::function<Mesh(double)>
        cutAt{}; // the mesh at another cut-off of its alpha test, between 0 and 1; of leaf cards alone
};

struct Object {
    std::string name;
    glm::vec3 colour{0.8F};
    std::vector<Level> levels; // finest first, never empty
    std::vector<Instance> instances;
    Motion motion;
    /// Of a mesh that deforms: one cycle, a mesh for each moving frame, all with the same triangles. The first is that of
    /// the one level. Empty: it is rigid.
    std::vector<std::shared_ptr<const Mesh>> poses{};

    [[nodiscard]] bool still() const { return motion.still() && poses.empty(); }
    [[nodiscard]] glm::vec3 shown(std::size_t level) const { return levels[level].colour.value_or(colour); }
};

/// The frames a cell renders: `still` ones with everything at rest (history techniques converge over them; the last is the
/// one that accuracy is scored on), then `moving` ones along the tracks (stability is scored on them). The still frames
/// begin with an empty history, or with that of `approach` frames along the camera's track before them: −approach … −1.
struct Timeline {
    int still = 60;
    int moving = 8;
    int approach = 0;
    [[nodiscard]] int frames() const { return still + moving; }
};

/// The walk that level-of-detail techniques are scored on: a camera path along which instances change levels. Motions of
/// objects start with it. Shadows are scored on the Timeline, not here.
struct LodWalk {
    int frames = 2;
    double band = 0.2; // length of a transition as a share of the distance in its middle, Level::until
    Track eye, target; // of the camera, by the walk's frames
};

/// A bound on one metric.
struct Bound {
    std::string metric; // one that `tolerance` may name
    double value = 0;
    bool below = true; // false: of an expected failure, which lies above

    [[nodiscard]] bool isKeptBy(double score) const { return below ? score < value : score > value; }
};

/// What a scene is there to show of one technique.
struct Expectation {
    std::string technique; // a variant; may name a technique that the catalogue does not have yet
    Bound bound;
    std::string reason;
};

/// Where a technique's error over one axis of `sweep` (studies/sweep/axis.h) first exceeds the scene's tolerance, in
/// the order of the axis' own values.
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
    std::vector<Expectation> expectations; // techniques that it breaks, or does not: one that stops failing is an error too
    std::vector<BreakExpectation> breaks;  // where techniques break as one of its quantities moves
    int referenceSamples = 1024;           // of an area light's or an environment's reference on the scored frame …
    int movingReferenceSamples = 256;      // … and on the moving frames
    glm::dvec3 moved{0};                   // what was added to all places of the file: moveToOrigin()
};

/// Adds `by`, in metres, to all that has a place in the world.
void translate(Scene& scene, const glm::dvec3& by);

/// World from object of an instance after `frames` frames of its object's motion.
glm::dmat4 placeAt(const Object& object, const Instance& instance, double frames);

/// Frames that are scored: the last still one and the moving ones.
std::vector<int> scoredFrames(const Scene& scene);

/// The scene at `frame`, from −Timeline::approach; levels of detail chosen by distance from the eye.
Snapshot snapshot(const Scene& scene, int frame);

} // namespace shadowbench
