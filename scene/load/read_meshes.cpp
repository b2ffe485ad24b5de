#include "base/error.h"
#include "base/memory.h"
#include "base/words.h"
#include "scene/load/memory_need.h"
#include "scene/load/scene_file.h"
#include "scene/masked_mesh.h"
#include "scene/meshes/import.h"
#include "scene/meshes/primitives.h"
#include "scene/meshes/procedural.h"
#include "scene/meshes/walker.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <glm/matrix.hpp>
#include <optional>

namespace shadowbench {
namespace {

constexpr int kMostSides = 4096;
constexpr int kMostPoses = 1000;
constexpr int kMostMaskTexels = 1 << 15;

const std::vector<std::string> kKeysOfFiles{"file", "part", "poses", "closed", "simplify",
                                            "unit", "up",   "flip",  "matrix", "mask_texels"};

/// A mesh to be made, and the words by which an equal one is found again.
struct Recipe {
    std::string words;
    std::function<Mesh()> make;
};

int trianglesOf(const TomlValue& value, int level) {
    if (level == 0) return value.get("triangles").integer(4, kMostTriangles);
    if (const auto own = value.find("triangles")) own->fail("the levels of lod state the triangles; leave this one out");
    return level;
}

std::uint32_t seedOf(const TomlValue& value) {
    const auto seed = value.find("seed");
    return seed ? static_cast<std::uint32_t>(seed->integer(0, 1'000'000'000)) : 1;
}

double positiveOr(const TomlValue& value, std::string_view name, double otherwise) {
    const auto given = value.find(name);
    return given ? given->positive() : otherwise;
}

glm::dvec3 sizeOf(const TomlValue& value) {
    const glm::dvec3 size = value.vector();
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) value.fail("expected 3 numbers above 0");
    return size;
}

Recipe bumpyRecipe(const TomlValue& value, int level) {
    value.only({"radius", "bump", "triangles", "seed"});
    const double radius = positiveOr(value, "radius", 0.5), bump = positiveOr(value, "bump", 0.3 * radius);
    if (!(bump < radius)) value.get("bump").fail("expected less than the radius");
    const int triangles = trianglesOf(value, level);
    const std::uint32_t seed = seedOf(value);
    return {fmt::format("bumpy {} {} {} {}", radius, bump, triangles, seed),
            [=] { return bumpy(radius, bump, triangles, seed); }};
}

Recipe sphereRecipe(const TomlValue& value, int level) {
    value.only({"radius", "triangles"});
    const double radius = value.get("radius").positive();
    const int triangles = trianglesOf(value, level);
    return {fmt::format("sphere {} {}", radius, triangles), [=] { return sphere(radius, triangles); }};
}

Recipe windmillRecipe(const TomlValue& value, int level) {
    value.only({"triangles"});
    const int triangles = trianglesOf(value, level);
    const bool tower = value.lastKey() == "windmill_tower";
    return {fmt::format("{} {}", value.lastKey(), triangles),
            [=] { return tower ? windmillTower(triangles) : windmillRotor(triangles); }};
}

Recipe treeRecipe(const TomlValue& value, int level) {
    value.only({"triangles", "seed"});
    const int triangles = trianglesOf(value, level);
    const std::uint32_t seed = seedOf(value);
    return {fmt::format("tree {} {}", triangles, seed), [=] { return tree(triangles, seed); }};
}

struct Cards {
    int count, texels;
    double size, cutoff;
    std::uint32_t seed;
};

Cards cardsOf(const TomlValue& value) {
    value.only({"count", "size", "texels", "cutoff", "seed"});
    const double size = value.get("size").positive();
    if (!(size < 1)) value.get("size").fail("expected less than the crown's radius, 1");
    const auto given = value.find("cutoff");
    const double cutoff = given ? given->positive() : 0.5;
    if (!(cutoff < 1)) given->fail("expected less than 1, the alpha of a leaf's middle");
    return {value.get("count").integer(1, 100'000), value.get("texels").integer(2, 4096), size, cutoff, seedOf(value)};
}

Recipe cardsRecipe(const TomlValue& value) {
    const Cards c = cardsOf(value);
    return {fmt::format("leaf cards {} {} {} {} {}", c.count, c.size, c.texels, c.cutoff, c.seed),
            [c] { return leafCards(c.count, c.size, c.texels, c.cutoff, c.seed); }};
}

/// How many poses a cycle of a procedural figure has.
int posesOf(const TomlValue& value) { return value.get("poses").integer(2, kMostPoses); }

Recipe walkerRecipe(const TomlValue& value, int pose) {
    value.only({"triangles", "poses"});
    const int triangles = trianglesOf(value, 0), poses = posesOf(value);
    return {fmt::format("walker {} {} {}", triangles, pose, poses), [=] { return walker(triangles, pose, poses); }};
}

Recipe plainRecipe(const TomlValue& value) {
    if (value.lastKey() == "leaf_cards") return cardsRecipe(value);
    if (value.lastKey() == "plane") {
        const double half = value.only({"half"}).get("half").positive();
        return {fmt::format("plane {}", half), [=] { return plane(half); }};
    }
    if (value.lastKey() == "box") {
        const glm::dvec3 size = sizeOf(value.only({"size"}).get("size"));
        return {fmt::format("box {} {} {}", size.x, size.y, size.z), [=] { return box(size); }};
    }
    value.only({"radius", "height", "sides"});
    const double radius = value.get("radius").positive(), height = value.get("height").positive();
    const int sides = value.get("sides").integer(3, kMostSides);
    return {fmt::format("column {} {} {}", radius, height, sides), [=] { return column(radius, height, sides); }};
}

Recipe recipe(const TomlValue& value, int level, int pose) {
    const std::string_view kind = value.lastKey();
    if (kind == "sphere") return sphereRecipe(value, level);
    if (kind == "bumpy") return bumpyRecipe(value, level);
    if (kind == "tree") return treeRecipe(value, level);
    if (kind == "windmill_tower" || kind == "windmill_rotor") return windmillRecipe(value, level);
    if (level > 0) value.fail("has no levels of detail; use levels = [{ mesh, until }, …] instead of lod");
    return kind == "walker" ? walkerRecipe(value, pose) : plainRecipe(value);
}

/// How the positions and windings of a mesh file become those of the scene: metres, +y up, counter-clockwise from outside.
struct Conventions {
    double metres = 1; // of the file's unit
    bool zUp = false;
    bool flip = false;
    std::optional<glm::dmat3> matrix; // after these
};

/// 9 numbers, column by column.
glm::dmat3 readAxes(const TomlValue& value) {
    const std::vector<TomlValue> numbers = value.list();
    if (numbers.size() != 9) value.fail(fmt::format("expected 9 numbers, column by column, got {}", numbers.size()));
    glm::dmat3 axes;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        axes[static_cast<int>(i / 3)][static_cast<int>(i % 3)] = numbers[i].number();
    return axes;
}

/// Parts of a file that are one mesh in the poses of a cycle; none where it is rigid.
std::vector<TomlValue> poseNames(const TomlValue& value) {
    const auto poses = value.find("poses");
    if (!poses) return {};
    if (const auto part = value.find("part")) part->fail("give either part or poses");
    if (const auto simplify = value.find("simplify")) simplify->fail("would simplify each pose in its own way");
    std::vector<TomlValue> names = poses->list();
    if (names.size() < 2 || names.size() > kMostPoses)
        poses->fail(fmt::format("expected 2 to {} names of meshes, got {}", kMostPoses, names.size()));
    return names;
}

Conventions conventionsOf(const TomlValue& value) {
    const auto unit = value.find("unit"), up = value.find("up"), flip = value.find("flip"), matrix = value.find("matrix");
    Conventions file{unit ? metresOf(*unit) : 1.0, up && isZUp(*up), flip && flip->boolean(), {}};
    if (matrix) file.matrix = readAxes(*matrix);
    return file;
}

void convert(Mesh& mesh, const Conventions& file) {
    for (glm::vec3& p : mesh.positions) {
        if (file.zUp) p = {p.x, p.z, -p.y}; // a turn about x: right stays right-handed
        p = glm::vec3(file.metres * glm::dvec3(p));
        if (file.matrix) p = glm::vec3(*file.matrix * glm::dvec3(p));
    }
    const bool mirrors = file.matrix && glm::determinant(*file.matrix) < 0; // so what was outside is inside
    if (file.flip != mirrors)
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
}

std::shared_ptr<const MaskedMesh> converted(std::shared_ptr<const MaskedMesh> cards, const Conventions& file) {
    if (cards == nullptr) return nullptr;
    MaskedMesh result = *cards;
    convert(result.mesh, file);
    return std::make_shared<const MaskedMesh>(std::move(result));
}

} // namespace

std::function<Mesh(double)> cutterOf(const TomlValue& value) {
    const auto cards = value.find("leaf_cards");
    if (!cards) return {};
    return [c = cardsOf(*cards)](double cutoff) { return leafCards(c.count, c.size, c.texels, cutoff, c.seed); };
}

double metresOf(const TomlValue& unit) {
    static const std::vector<std::pair<std::string, double>> units{
        {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
    std::vector<std::string> names;
    for (const auto& [name, metres] : units) names.push_back(name);
    const std::string wanted = unit.oneOf(names);
    return std::ranges::find(units, wanted, [](const auto& known) { return known.first; })->second;
}

int maskTexelsOf(const TomlValue& texels) { return texels.integer(1, kMostMaskTexels); }

void requireNoKeyOfMesh(const TomlValue& object) {
    for (const std::string& name : kKeysOfFiles)
        if (const auto key = object.find(name)) key->fail(fmt::format("belongs in the mesh: mesh = {{ …, {} = … }}", name));
}

bool isZUp(const TomlValue& up) { return up.oneOf({"y", "z"}) == "z"; }

std::shared_ptr<const Mesh> MeshStore::get(const TomlValue& value, int triangles) {
    value.only({"plane",    "box",        "sphere", "column", "bumpy",  "windmill_tower", "windmill_rotor",
                "tree",     "leaf_cards", "walker", "file",   "part",   "poses",          "closed",
                "simplify", "unit",       "up",     "flip",   "matrix", "mask_texels"});
    if (value.find("file")) {
        const auto poses = poseNames(value.only(kKeysOfFiles));
        return imported(value, poses.empty() ? value.find("part") : poses.front(), triangles);
    }
    const std::vector<TomlValue> members = value.members();
    if (members.size() != 1) value.fail(fmt::format("expected one kind of mesh, got {}", members.size()));
    if (std::ranges::find(kKeysOfFiles, members[0].lastKey()) != kKeysOfFiles.end())
        members[0].fail("belongs to a mesh from a file");
    return generated(members[0], triangles, 0);
}

std::vector<std::shared_ptr<const Mesh>> MeshStore::poses(const TomlValue& value) {
    std::vector<std::shared_ptr<const Mesh>> poses;
    if (const auto figure = value.find("walker"))
        for (int pose = 0; pose < posesOf(*figure); ++pose) poses.push_back(generated(*figure, 0, pose));
    for (const TomlValue& name : poseNames(value)) {
        poses.push_back(imported(value, name, 0));
        if (poses.back()->triangles != poses.front()->triangles)
            name.fail("has other triangles than the first pose; expected one mesh with its vertices moved");
    }
    return poses;
}

std::shared_ptr<const Mesh> MeshStore::generated(const TomlValue& generator, int triangles, int pose) {
    const Recipe wanted = recipe(generator, triangles, pose);
    std::shared_ptr<const Mesh>& mesh = meshes_[wanted.words];
    if (mesh == nullptr) {
        mesh = std::make_shared<const Mesh>(wanted.make());
        requireWellFormed(*mesh, generator.where());
        requireRoom(*mesh, generator);
    }
    return mesh;
}

void MeshStore::requireRoom(const Mesh& another, const TomlValue& key) {
    bytes_ += bytesOf(another);
    if (const std::uint64_t there = memoryThere(); bytes_ > there)
        key.fail(fmt::format("with it the scene's meshes take {} of memory, and there is {}: take fewer or coarser ones",
                             inBytes(bytes_), inBytes(there)));
}

/// A file is read once, however many of its meshes a scene takes.
const Mesh& MeshStore::partOf(const std::filesystem::path& file, const TomlValue& part, int maskTexels) {
    if (file.extension() != ".gltf" && file.extension() != ".glb")
        throw BadInput("a part is a mesh of a .gltf or .glb file, by name");
    const auto [known, isNew] = parts_.try_emplace({file, maskTexels});
    if (isNew) known->second = importParts(file, maskTexels);
    const std::string wanted = part.text();
    if (const auto found = known->second.find(wanted); found != known->second.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, mesh] : known->second) names.push_back(name);
    throw BadInput(fmt::format("{} has no mesh \"{}\"{}", file.string(), wanted, didYouMean(wanted, names)));
}

std::shared_ptr<const Mesh> MeshStore::imported(const TomlValue& value, const std::optional<TomlValue>& part,
                                                int triangles) {
    const TomlValue name = value.get("file");
    const auto closed = value.find("closed");
    const auto simplify = value.find("simplify");
    if (simplify && triangles > 0) simplify->fail("the levels of lod state the triangles; leave this one out");
    const int wanted = simplify ? simplify->integer(4, kMostTriangles) : triangles;
    const Conventions conventions = conventionsOf(value);
    const auto texels = value.find("mask_texels");
    if (texels && !part) texels->fail("belongs to a part of a glTF file");
    const int maskTexels = texels ? maskTexelsOf(*texels) : 0;
    const std::filesystem::path file = folder_ / name.text();
    std::string words =
        fmt::format("file {} {} {} {} {} {} {}", file.string(), closed && closed->boolean(), wanted, conventions.metres,
                    conventions.zUp, conventions.flip, part ? "part " + part->text() : "");
    if (texels) words += fmt::format(" mask {}", maskTexels);
    for (int i = 0; conventions.matrix && i < 9; ++i) words += fmt::format(" {}", (*conventions.matrix)[i / 3][i % 3]);
    std::shared_ptr<const Mesh>& mesh = meshes_[words];
    if (mesh != nullptr) return mesh;

    Mesh made;
    try {
        made = part ? partOf(file, *part, maskTexels) : importMesh(file);
    } catch (const BadInput& error) {
        name.fail(error.what());
    }
    made.closed = closed && closed->boolean();
    const std::shared_ptr<const MaskedMesh> cards = wanted > 0 ? nullptr : converted(std::move(made.cards), conventions);
    convert(made, conventions);
    const std::string what = part ? fmt::format("{}: mesh \"{}\"", name.where(), part->text()) : name.where();
    made = withoutFlat(made);
    requireWellFormed(made, what);
    if (wanted > 0) made = withoutFlat(simplified(made, wanted));
    requireWellFormed(made, what);
    requireRoom(made, name);
    made.cards = cards;
    mesh = std::make_shared<const Mesh>(std::move(made));
    return mesh;
}

} // namespace shadowbench
