// The loader's parts, each reading one section of a scene file.
#pragma once

#include "base/toml_value.h"
#include "scene/scene.h"
#include "scene/sky.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {

constexpr int kMostTriangles = 4'000'000; // of one mesh; more is taken for a typing error

/// Of a number in a scene file, and of the distance of anything from the origin, in metres: shaders multiply up to three
/// coordinates with each other, and their numbers end at 3·10³⁸.
constexpr double kLargestNumber = 1e12;

/// The meshes of one scene: a generator called twice with the same arguments gives one shared mesh.
class MeshStore {
public:
    explicit MeshStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The mesh that a `mesh = { … }` value describes; `triangles` > 0 asks for that level of detail instead of the value's
    /// own count.
    std::shared_ptr<const Mesh> get(const TomlValue& value, int triangles = 0);

    /// Of a mesh that deforms: Object::poses, the first of which is the mesh; else none.
    std::vector<std::shared_ptr<const Mesh>> poses(const TomlValue& value);

private:
    std::shared_ptr<const Mesh> generated(const TomlValue& generator, int triangles, int pose);
    std::shared_ptr<const Mesh> imported(const TomlValue& value, const std::optional<TomlValue>& part, int triangles);
    const Mesh& partOf(const std::filesystem::path& file, const TomlValue& part, int maskTexels);
    /// Throws at the key once the meshes so far cannot be in memory.
    void requireRoom(const Mesh& another, const TomlValue& key);

    std::filesystem::path folder_; // that mesh files are relative to
    std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
    std::uint64_t bytes_ = 0; // of meshes_
    /// Of glTF files with so many texels of a mask at most, by name.
    std::map<std::pair<std::filesystem::path, int>, std::map<std::string, Mesh>> parts_;
};

/// What Level::cutAt is, of a `mesh = { … }` value that MeshStore::get() has read.
std::function<Mesh(double)> cutterOf(const TomlValue& value);

/// Throws at a key that a mesh from a file has and that stands beside `mesh`.
void requireNoKeyOfMesh(const TomlValue& object);

/// Of the texts that `unit` and `up` may be.
double metresOf(const TomlValue& unit);
bool isZUp(const TomlValue& up);

/// Of `mask_texels`.
int maskTexelsOf(const TomlValue& texels);

/// Where `own`, the table of a scene file in `folder`, names a glTF file: adds what it leaves to that file, its objects
/// first.
void completeFromGltf(toml::table& own, const TomlSource& source, const std::filesystem::path& folder);

/// `[light]`; `folder` is what image files are relative to.
void readLight(const TomlValue& value, const std::filesystem::path& folder, Scene& scene);

/// The `sky` and the `suns` of a `[light]` that is an environment.
EnvironmentLight readEnvironment(const TomlValue& light, const std::filesystem::path& folder);

/// A vector other than zero, made of unit length. One that has it already, to rounding, stays as it is: what export writes
/// is read as the very same numbers.
glm::dvec3 readDirection(const TomlValue& value);

/// One `[[object]]`; `eye` is where scattered instances keep clear of. `number` counts from 1.
Object readObject(const TomlValue& value, int number, const glm::dvec3& eye, MeshStore& meshes);

/// A list of key frames, `[{ frame = 0, <name> = [x, y, z] }, …]`, none before `first`; keys without `name` are left out.
Track readTrack(const TomlValue& path, const std::string& name, int first = 0);

/// `[tolerance]`: metric name → worst value that a viewer accepts. `metrics`: the names that a bound can have; empty: any.
std::map<std::string, double> readTolerances(const TomlValue& value, const std::vector<std::string>& metrics);

/// `[expect]`: the techniques that the scene breaks, those that hold, and where they break as a quantity moves.
void readExpectations(const TomlValue& value, const std::vector<std::string>& metrics, Scene& scene);

/// Whether an object or scene belongs to `profile`: its `profile` key names it, or it has none.
bool belongsTo(const TomlValue& value, Profile profile);

/// The first thing that leaves the scene without a defined answer: the key it is about, and what is wrong.
struct Problem {
    std::string key; // "camera.eye", "light.centre", "light.u", …
    std::string sentence;
};
std::optional<Problem> findProblem(const Scene& scene);

/// Moves a scene whose camera is far from the origin to it, the eye to within a view distance: what draws keeps positions in
/// the world in single precision, whose steps would be seen. Nothing else changes, to the rounding of one addition in double
/// precision.
void moveToOrigin(Scene& scene);

} // namespace shadowbench
