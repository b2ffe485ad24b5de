#include "base/limits.h"
#include "base/random.h"
#include "scene/load/scene_file.h"
#include "scene/meshes/scatter.h"
#include "scene/scene.h"
#include "scene/similarity.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace shadowbench {
namespace {

constexpr double kFullTurn = 360;

/// Of one object; more is taken for a typing error.
int mostInstances() { return static_cast<int>(limitOf(Limit::Instances)); }

/// `until` distances must grow: a level that ends before the previous one is never drawn.
void requireGrowing(const std::vector<Level>& levels, const TomlValue& value) {
    for (std::size_t i = 1; i < levels.size(); ++i)
        if (!(levels[i].until > levels[i - 1].until)) value.fail("the distances of until must grow from level to level");
}

glm::vec3 readColour(const TomlValue& value) {
    const glm::dvec3 colour = value.vector();
    for (int i = 0; i < 3; ++i)
        if (colour[i] < 0 || colour[i] > 1) value.fail("expected 3 numbers from 0 to 1");
    return glm::vec3(colour);
}

std::vector<Level> levelsFromList(const TomlValue& list, MeshStore& meshes) {
    std::vector<Level> levels;
    const std::vector<TomlValue> entries = list.list();
    if (entries.empty()) list.fail("expected at least one level");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        entries[i].only({"mesh", "until", "colour"});
        Level level{.mesh = meshes.get(entries[i].get("mesh")), .cutAt = cutterOf(entries[i].get("mesh"))};
        if (const auto colour = entries[i].find("colour")) level.colour = readColour(*colour);
        if (const auto until = entries[i].find("until"))
            level.until = until->positive();
        else if (i + 1 < entries.size())
            entries[i].get("until");
        levels.push_back(std::move(level));
    }
    requireGrowing(levels, list);
    return levels;
}

std::vector<Level> levelsFromLod(const TomlValue& mesh, const TomlValue& lod, MeshStore& meshes) {
    lod.only({"triangles", "until"});
    const std::vector<TomlValue> triangles = lod.get("triangles").list(), until = lod.get("until").list();
    if (triangles.size() != until.size() + 1)
        lod.get("until").fail(
            fmt::format("expected {} distances, one fewer than levels, got {}", triangles.size() - 1, until.size()));
    std::vector<Level> levels;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        levels.push_back({meshes.get(mesh, triangles[i].integer(4, kMostTriangles))});
        if (i < until.size()) levels.back().until = until[i].positive();
    }
    requireGrowing(levels, lod.get("until"));
    return levels;
}

std::vector<Level> readLevels(const TomlValue& value, MeshStore& meshes) {
    const auto list = value.find("levels"), lod = value.find("lod");
    if (list && value.find("mesh")) list->fail("the levels state the meshes; leave mesh out");
    if (list && lod) lod->fail("give either levels or lod");
    if (list) return levelsFromList(*list, meshes);
    if (lod) return levelsFromLod(value.get("mesh"), *lod, meshes);
    return {{.mesh = meshes.get(value.get("mesh")), .cutAt = cutterOf(value.get("mesh"))}};
}

/// Of an object whose one mesh deforms; else none.
std::vector<std::shared_ptr<const Mesh>> readPoses(const TomlValue& value, MeshStore& meshes) {
    const auto levels = value.find("levels"), lod = value.find("lod");
    const std::vector<TomlValue> entries = levels ? levels->list() : std::vector{value};
    std::vector<std::shared_ptr<const Mesh>> poses;
    for (const TomlValue& entry : entries) {
        poses = meshes.poses(entry.get("mesh"));
        if (!poses.empty() && (lod || entries.size() > 1)) entry.fail("deforms; levels of detail are of rigid meshes");
    }
    return poses;
}

/// World from object, 16 numbers column by column: a shift, a turn and one scale, so that a spin never shears the object.
glm::dmat4 readMatrix(const TomlValue& value) {
    const std::vector<TomlValue> numbers = value.list();
    if (numbers.size() != 16) value.fail(fmt::format("expected 16 numbers, column by column, got {}", numbers.size()));
    glm::dmat4 matrix;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = numbers[i].number();
    if (glm::transpose(matrix)[3] != glm::dvec4(0, 0, 0, 1))
        value.fail("expected numbers 4, 8 and 12 to be 0 and number 16 to be 1: a shift, a turn and a scale");
    const glm::dmat3 axes(matrix);
    if (!(glm::determinant(axes) > 0)) value.fail("is flat or mirrors the object; expected a determinant above 0");
    if (!scalesEvenly(axes))
        value.fail(
            "stretches or shears the object; expected a shift, a turn and one scale (a mesh from a file has a matrix of "
            "its own)");
    return matrix;
}

glm::dmat4 readPlace(const TomlValue& value) {
    value.only({"at", "turn", "scale", "matrix"});
    if (value.find("matrix")) return readMatrix(value.only({"matrix"}).get("matrix"));
    const auto at = value.find("at"), turn = value.find("turn"), scale = value.find("scale");
    return placed(at ? at->vector() : glm::dvec3(0), turn ? turn->number() : 0.0, scale ? scale->positive() : 1.0);
}

/// A number, or a list of two that bound a range.
glm::dvec2 readRange(const TomlValue& value) {
    if (!value.isList()) return glm::dvec2(value.number());
    const std::vector<TomlValue> ends = value.list();
    if (ends.size() != 2) value.fail(fmt::format("expected a number or 2 that bound a range, got {}", ends.size()));
    const glm::dvec2 range(ends[0].number(), ends[1].number());
    if (range.x > range.y) value.fail("expected the lower end of the range first");
    return range;
}

glm::dvec2 readHalf(const TomlValue& value) {
    if (!value.isList()) return glm::dvec2(value.positive());
    const std::vector<TomlValue> sides = value.list();
    if (sides.size() != 2) value.fail(fmt::format("expected a number or 2 (along x and z), got {}", sides.size()));
    return {sides[0].positive(), sides[1].positive()};
}

Scatter readScatter(const TomlValue& value, const glm::dvec3& eye) {
    value.only({"count", "half", "spacing", "centre", "jitter", "turn", "scale", "clear", "seed"});
    Scatter scatter;
    scatter.count = value.get("count").integer(1, mostInstances());
    const auto half = value.find("half"), spacing = value.find("spacing");
    if (half.has_value() == spacing.has_value())
        value.fail("give either half (sides of the field) or spacing (between instances)");
    scatter.half = half ? readHalf(*half) : glm::dvec2(0.5 * spacing->positive() * std::sqrt(scatter.count));
    if (const auto centre = value.find("centre")) scatter.centre = centre->vector();
    if (const auto jitter = value.find("jitter")) scatter.jitter = jitter->number();
    if (scatter.jitter < 0 || scatter.jitter > 1) value.get("jitter").fail("expected a number from 0 to 1");
    if (const auto turn = value.find("turn")) scatter.turn = readRange(*turn);
    if (const auto scale = value.find("scale")) scatter.scale = readRange(*scale);
    if (!(scatter.scale.x > 0)) value.get("scale").fail("expected numbers above 0");
    if (const auto clear = value.find("clear")) scatter.clear = clear->positive();
    if (const auto seed = value.find("seed")) scatter.seed = static_cast<std::uint32_t>(seed->integer(0, 1'000'000'000));
    scatter.keepOff = {eye.x, eye.z};
    return scatter;
}

std::vector<glm::dmat4> readPlaces(const TomlValue& value, const glm::dvec3& eye) {
    const auto place = value.find("place"), scatter = value.find("scatter");
    if (place && scatter) scatter->fail("give either place or scatter");
    if (scatter) {
        std::vector<glm::dmat4> places = scattered(readScatter(*scatter, eye));
        if (places.empty())
            scatter->fail("the whole field lies within clear metres of the camera; make it larger or clear smaller");
        return places;
    }
    if (!place) return {glm::dmat4(1)};
    const std::vector<TomlValue> entries = place->list();
    if (entries.size() > limitOf(Limit::Instances))
        place->fail(fmt::format("has {} instances, {}", entries.size(), beyond(Limit::Instances)));
    std::vector<glm::dmat4> places;
    for (const TomlValue& entry : entries) places.push_back(readPlace(entry));
    if (places.empty()) place->fail("expected at least one place");
    return places;
}

std::vector<double> readPhaseList(const TomlValue& list, std::size_t count) {
    const std::vector<TomlValue> given = list.list();
    if (given.size() != count)
        list.fail(fmt::format("expected {} numbers, one for each instance, got {}", count, given.size()));
    std::vector<double> phases;
    for (const TomlValue& phase : given) phases.push_back(phase.number());
    return phases;
}

/// Each instance's turn at rest: one for all, a list of them, or its own at random.
std::vector<double> readPhases(const TomlValue& spin, std::size_t count) {
    const auto phase = spin.find("phase");
    if (!phase) return std::vector<double>(count, 0.0);
    if (phase->isList()) return readPhaseList(*phase, count);
    if (!phase->isText()) return std::vector<double>(count, phase->number());
    phase->oneOf({"random"});
    std::vector<double> phases(count);
    for (std::size_t i = 0; i < count; ++i) phases[i] = kFullTurn * hashed(i);
    return phases;
}

/// Each instance's pose at rest: one for all, a list of them, or its own at random.
void readStartPoses(const TomlValue& value, Object& object) {
    if (object.poses.empty()) value.fail("is of a mesh that deforms: walker, or a file with poses");
    const int last = static_cast<int>(object.poses.size()) - 1;
    if (value.isText()) value.oneOf({"random"});
    if (value.isList() && value.list().size() != object.instances.size())
        value.fail(
            fmt::format("expected {} numbers, one for each instance, got {}", object.instances.size(), value.list().size()));
    for (std::size_t i = 0; i < object.instances.size(); ++i)
        object.instances[i].pose = value.isText()   ? std::min(last, static_cast<int>(hashed(i) * (last + 1)))
                                   : value.isList() ? value.list()[i].integer(0, last)
                                                    : value.integer(0, last);
}

void readSpin(const TomlValue& spin, Object& object) {
    spin.only({"axis", "degrees_per_frame", "phase"});
    object.motion.axis = readDirection(spin.get("axis"));
    object.motion.degreesPerFrame = spin.get("degrees_per_frame").number();
    const std::vector<double> phases = readPhases(spin, object.instances.size());
    for (std::size_t i = 0; i < phases.size(); ++i) object.instances[i].phase = phases[i];
}

} // namespace

Object readObject(const TomlValue& value, int number, const glm::dvec3& eye, MeshStore& meshes) {
    requireNoKeyOfMesh(value);
    value.only({"name", "colour", "mesh", "lod", "levels", "place", "scatter", "offset", "spin", "path", "pose", "profile"});
    Object object;
    const auto name = value.find("name");
    object.name = name ? name->text() : fmt::format("object {}", number);
    if (const auto colour = value.find("colour")) object.colour = readColour(*colour);
    object.levels = readLevels(value, meshes);
    object.poses = readPoses(value, meshes);
    const auto offset = value.find("offset");
    const glm::dmat4 shift = glm::translate(glm::dmat4(1), offset ? offset->vector() : glm::dvec3(0));
    for (const glm::dmat4& place : readPlaces(value, eye)) object.instances.push_back({place * shift, 0});
    if (const auto spin = value.find("spin")) readSpin(*spin, object);
    if (const auto pose = value.find("pose")) readStartPoses(*pose, object);
    if (const auto path = value.find("path")) {
        for (const TomlValue& key : path->list()) key.only({"frame", "shift"}).get("shift");
        object.motion.shift = readTrack(*path, "shift");
    }
    return object;
}

Track readTrack(const TomlValue& path, const std::string& name, int first) {
    Track track;
    double last = first - 1;
    for (const TomlValue& key : path.list()) {
        const double frame = key.get("frame").number();
        if (frame < first || frame <= last)
            key.get("frame").fail(first < 0 ? fmt::format("frames must grow, from {} (the first of the approach)", first)
                                            : "frames must grow, from 0 (the last still frame)");
        last = frame;
        if (const auto value = key.find(name)) track.keys.push_back({frame, value->vector()});
    }
    return track;
}

bool belongsTo(const TomlValue& value, Profile profile) {
    const auto given = value.find("profile");
    if (!given) return true;
    const std::vector<std::string> names{"gate", "standard", "paper"};
    if (!given->isList()) return given->oneOf(names) == name(profile);
    bool found = false;
    for (const TomlValue& entry : given->list()) found = entry.oneOf(names) == name(profile) || found;
    return found;
}

} // namespace shadowbench
