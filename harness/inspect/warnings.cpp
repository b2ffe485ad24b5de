#include "harness/inspect/warnings.h"

#include "harness/inspect/meshes.h"
#include "scene/load/load.h"
#include "techniques/shared/light_views/light_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::inspect {
namespace {

using Warnings = std::vector<Warning>;
using groundtruth::Surface;

std::string placeOf(const glm::dvec3& p) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z); }

std::string nameOf(const Evidence& e, std::uint32_t id) { return namesOfInstances(e.scene).at(id - 1); }

bool isWithin(const Bounds& box, const glm::dvec3& point) { return glm::clamp(point, box.low, box.high) == point; }

/// Whether an object of that extent is out of all proportion to what the camera was set up for, as a file in centimetres is
/// that is read as metres. Grounds may be wide, but they are not high; and a camera that is meant to see far says so.
bool isHuge(const glm::dvec3& extent, double view, double far) {
    const double size = glm::length(extent), least = std::min({extent.x, extent.y, extent.z});
    return (size > std::max(20 * view, far) && least > view) || size > 1e4 * view;
}

double metresOfPixel(const Evidence& e, double distance) {
    return 2 * distance * std::tan(0.5 * glm::radians(e.snapshot.camera.fovy)) / e.scene.size.y;
}

void judgeSizes(const Evidence& e, const std::vector<MeshReport>& meshes, Warnings& warnings) {
    const double whole = glm::distance(e.box.low, e.box.high);
    const double view = glm::distance(e.snapshot.camera.eye, e.snapshot.camera.target);
    if (whole < 0.01)
        warnings.push_back({fmt::format("the whole scene is {:.2g} m across", whole),
                            "scenes are in metres: correct the unit of its mesh files, or scale it"});
    for (const MeshReport& mesh : meshes) {
        const glm::dvec3 extent = mesh.box.high - mesh.box.low;
        const std::string what = fmt::format("{} is {:.4g} m across, and the camera looks at what is {:.3g} m away",
                                             mesh.name, glm::length(extent), view);
        if (isHuge(extent, view, e.snapshot.camera.far))
            warnings.push_back(
                {what, "if its file is in centimetres, write unit = \"cm\" beside it (in millimetres: \"mm\")"});
        else if (glm::length(extent) < metresOfPixel(e, view))
            warnings.push_back({what, "correct the unit of its file or its scale: it is smaller than a pixel"});
    }
}

/// The longest side of a triangle, in metres of the world.
double longestSide(const Mesh& mesh, const glm::dmat4& world) {
    std::vector<glm::dvec3> corners;
    for (const glm::vec3& p : mesh.positions) corners.emplace_back(world * glm::dvec4(p, 1));
    double longest = 0;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) longest = std::max(longest, glm::distance(corners[t[i]], corners[t[(i + 1) % 3]]));
    return longest;
}

/// Rasterisers keep positions and depths in 32 bits, and a map has so many texels for the whole scene.
void judgePrecision(const Evidence& e, Warnings& warnings) {
    constexpr double step = 0x1p-23, mostShift = 0.1; // of a single-precision number; of a pixel
    const Camera& camera = e.snapshot.camera;
    const double view = glm::distance(camera.eye, camera.target);
    for (const Batch& batch : e.snapshot.batches) {
        const Bounds own = batch.mesh->bounds();
        const Placement& placement = batch.placements.front();
        const glm::dmat3 axes(placement.world);
        const double far = glm::length(axes[0]) * glm::length(glm::max(glm::abs(own.low), glm::abs(own.high)));
        if (step * far > mostShift * metresOfPixel(e, view))
            warnings.push_back(
                {fmt::format("vertices of {} are up to {:.3g} m from its own origin, where positions in single "
                             "precision lie {:.2g} m apart",
                             nameOf(e, placement.id), far, step * far),
                 "move them to the origin and give the mesh a place, or cut it into parts that have theirs"});
        constexpr double mostOff = 2; // pixels, of a bound: what is drawn is off by less
        const double side = longestSide(*batch.mesh, placement.world), off = step * side / metresOfPixel(e, camera.near);
        if (off > mostOff)
            warnings.push_back(
                {fmt::format("triangles of {} are {:.3g} m long, and near is {:.2g} m: a rasteriser in single precision may "
                             "draw one that passes the camera {:.2g} pixels beside its place",
                             nameOf(e, placement.id), side, camera.near, off),
                 fmt::format("cut them, make them no larger than what is seen, or make near more than {:.1g}",
                             2 * camera.near * off / mostOff)});
    }
    const double leastNear = view * step / 1e-3; // two depths at the target are a thousandth of the way apart
    if (camera.near < leastNear)
        warnings.push_back(
            {fmt::format("near is {:.2g} m: surfaces at the target that are {:.2g} m apart have the same depth", camera.near,
                         view * view * step / camera.near),
             fmt::format("make it more than {:.1g}", 2 * leastNear)});
    constexpr double mostStretch = 100; // pixels of an image 256 wide
    const auto texels = e.view.texels(e.seen);
    const double scale = static_cast<double>(e.scene.size.x) / e.seen.visibility.width();
    if (texels && texels->median * scale > mostStretch * e.scene.size.x / 256)
        warnings.push_back(
            {fmt::format("a texel of a map of 1024² over the whole scene, which is {:.4g} m across, covers {:.2g} "
                         "pixels",
                         glm::distance(e.box.low, e.box.high), texels->median * scale),
             "make the ground no larger than what is seen, or expect shadows of maps that follow the view alone"});
}

/// What lies flat at the bottom of a z-up file stands upright at an end of z.
void judgeAxes(const Evidence& e, Warnings& warnings) {
    const glm::dvec3 up = glm::abs(e.snapshot.camera.up);
    if (up.y < std::max(up.x, up.z)) return;
    const FlatAreas flat = flatAreas(e.scene);
    const double depth = e.box.high.z - e.box.low.z;
    const double fromEnd = std::min(std::abs(flat.place.z - e.box.low.z), std::abs(flat.place.z - e.box.high.z));
    if (flat.area.z <= 4 * std::max(flat.area.x, flat.area.y) || fromEnd > 0.05 * depth) return;
    warnings.push_back({"the largest flat surface stands upright, across z, and the camera's up is y",
                        "if its mesh file has z up, write up = \"z\" beside it"});
}

void judgeMeshes(const Evidence& e, const std::vector<MeshReport>& meshes, Warnings& warnings) {
    for (const MeshReport& mesh : meshes) {
        const EdgeFaults& edges = mesh.faults.edges;
        const bool isNearlyClosed = 20 * (edges.open.count + edges.crowded.count) < mesh.triangles;
        if (edges.turned.count > 0 && isNearlyClosed)
            warnings.push_back({fmt::format("some faces of {} are turned inside out: at {} edges neighbours face opposite "
                                            "ways, the first near {}",
                                            mesh.name, edges.turned.count, placeOf(edges.turned.place)),
                                "turn them in the modelling program (Blender: Mesh > Normals > Recalculate Outside)"});
        const bool isRoom = isWithin(mesh.box, e.snapshot.camera.eye);
        const Fault& parts = mesh.faults.turnedParts;
        if (edges.closed() && mesh.faults.volume < 0 && !isRoom)
            warnings.push_back({fmt::format("{} is closed and turned inside out", mesh.name),
                                "write flip = true and closed = true beside its file, or turn it in the modelling program"});
        else if (parts.count > 0 && !isRoom)
            warnings.push_back({fmt::format("{} of the {} parts of {} are turned inside out, the first near {}", parts.count,
                                            mesh.faults.parts, mesh.name, placeOf(parts.place)),
                                "turn them in the modelling program (Blender: Mesh > Normals > Recalculate Outside)"});
    }
}

/// A closed mesh that holds either the eye or the light hides all that is seen from the light.
bool judgeEnclosure(const Evidence& e, Warnings& warnings) {
    const glm::dvec3 &eye = e.snapshot.camera.eye, &lamp = e.snapshot.light.centre;
    const LightKind kind = e.snapshot.light.kind;
    const bool isSomewhere = kind != LightKind::Directional && kind != LightKind::Environment;
    for (const Batch& batch : e.snapshot.batches) {
        const Bounds own = batch.mesh->bounds();
        for (const Placement& placement : batch.placements) {
            const Bounds box = transformed(own, placement.world);
            const auto holds = [&](const glm::dvec3& point) {
                const glm::dvec3 local(glm::inverse(placement.world) * glm::dvec4(point, 1.0));
                return isWithin(box, point) && edgeFaultsOf(*batch.mesh).closed() &&
                       std::abs(windingNumber(*batch.mesh, local)) > 0.5;
            };
            const bool holdsEye = holds(eye), holdsLamp = isSomewhere && holds(lamp);
            if (holdsEye == holdsLamp) continue;
            warnings.push_back(
                {fmt::format("the {} is inside {}, a closed mesh, and the {} is not", holdsEye ? "camera" : "light",
                             nameOf(e, placement.id), holdsEye ? "light" : "camera"),
                 fmt::format("move the {} out", holdsEye ? "camera" : "light")});
            return true;
        }
    }
    return false;
}

void judgeLight(const Evidence& e, Warnings& warnings) {
    constexpr double least = 1e-5; // of how far the camera looks: nothing that is built leaves so little room
    const double margin = least * glm::distance(e.snapshot.camera.eye, e.snapshot.camera.target);
    if (const auto id = surfaceAtLight(e.snapshot, margin))
        warnings.push_back({fmt::format("the light is less than {:.2g} m from a surface of {}", margin, nameOf(e, *id)),
                            "move it away: what lies so near hides half of the scene from it"});
}

/// How much of the shadow that is seen lies beside what one map of the light holds.
double shadowBesideTheMap(const Evidence& e) {
    const techniques::LightView view = techniques::fitToScene(e.snapshot.light, e.snapshot);
    double beside = 0, all = 0;
    for (std::size_t i = 0; i < e.seen.visibility.size(); ++i) {
        if (e.seen.hits.surface[i] != Surface::Receiver) continue;
        const double hidden = 1 - e.seen.visibility[i];
        all += hidden;
        if (!techniques::texelAt(view, e.seen.hits.position[i], {1, 1})) beside += hidden;
    }
    return all > 0 ? beside / all : 0;
}

void judgeMap(const Evidence& e, Warnings& warnings) {
    constexpr double few = 0.05; // a rim of pixels at the map's own is no matter
    const Light& light = e.snapshot.light;
    if (light.isEnvironment() || light.kind == LightKind::Directional || shadowBesideTheMap(e) <= few) return;
    const bool isFlat = light.kind == LightKind::Rectangle || light.kind == LightKind::Disk;
    warnings.push_back(
        {fmt::format("part of the shadow in view lies outside the 160° that one map of the light sees, which looks to {}",
                     isFlat ? "the side of the camera's target" : "the middle of the scene"),
         "move the light out of what it lights, or expect techniques with a single map to miss that part; sm-cube, volumes "
         "and wedges do not"});
}

void judgeEmptyView(const Evidence& e, Warnings& warnings) {
    const Camera& camera = e.snapshot.camera;
    double nearest = HUGE_VAL, farthest = -HUGE_VAL;
    for (const glm::dvec3& corner : e.box.corners()) {
        const double depth = camera.project(corner, e.scene.size).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    Warning warning{"nothing of the scene is in view",
                    "turn the camera's target to the scene, whose middle is " + placeOf(e.box.centre())};
    if (farthest < camera.near) {
        warning.what += farthest < 0 ? ": all of it is behind the camera" : ": all of it is nearer than near";
        if (farthest > 0) warning.remedy = fmt::format("make near less than {:.2g}", nearest);
    } else if (nearest > camera.far) {
        warning.what += ": all of it is farther than far";
        warning.remedy = fmt::format("make far more than {:.4g}", farthest);
    }
    warnings.push_back(warning);
}

/// How much of what is seen the light would reach from the other side: coarsely.
double litFromOpposite(const Evidence& e) {
    Light light = e.snapshot.light;
    light.direction = -light.direction;
    const FrameReport report = e.view.seen(light, {64, 64}, false).report;
    return report.receivers * report.lit;
}

std::string remedyOfDirection(const glm::dvec3& d) {
    return fmt::format("direction points the way that the light travels: is it upside down? Try [{:.3g}, {:.3g}, {:.3g}]",
                       -d.x, -d.y, -d.z);
}

/// The middle one of the pixels that are receivers.
glm::dvec3 someReceiver(const View::Seen& seen) {
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < seen.visibility.size(); ++i)
        if (seen.hits.surface[i] == Surface::Receiver) points.push_back(seen.hits.position[i]);
    return points.at(points.size() / 2);
}

bool isFromBelow(const Evidence& e) {
    const Light& light = e.snapshot.light;
    return light.kind == LightKind::Directional ? light.direction.y > 0 : light.centre.y < e.box.low.y;
}

Warning mostFacesAway(const Evidence& e) {
    const FrameReport& frame = e.seen.report;
    const Light& light = e.snapshot.light;
    const std::string what = fmt::format("{:.3g} % of what is seen faces away from the light{}",
                                         100 * frame.facesAway / (frame.facesAway + frame.receivers),
                                         frame.lit == 1        ? ", and all of the rest is lit"
                                         : frame.shadowed == 1 ? ", and all of the rest is shadowed"
                                                               : "");
    if (light.kind == LightKind::Directional) return {what, remedyOfDirection(light.direction)};
    if (isFromBelow(e))
        return {fmt::format("{}, which is {:.3g} m below the whole scene", what, e.box.low.y - light.centre.y),
                "move it above"};
    return {what, "move the light to the camera's side of it"};
}

Warning allShadowed(const Evidence& e, bool isEnclosed) {
    const Light& light = e.snapshot.light;
    const std::string what = "no pixel of a receiver is lit: there is nothing to score";
    if (isEnclosed) return {what, "follow the warning above"};
    if (light.kind == LightKind::Directional && litFromOpposite(e) > 0.05) return {what, remedyOfDirection(light.direction)};
    const View::Hiding hiding = e.view.hides(someReceiver(e.seen));
    if (hiding.id == 0) return {what, "move the light to where something sees it"};
    const std::string who = nameOf(e, hiding.id);
    if (light.kind == LightKind::Directional)
        return {fmt::format("{}; {} is in the way", what, who), "choose another direction, or open what encloses the scene"};
    return {fmt::format("{}; {}, {:.3g} m from the light, is in the way", what, who, hiding.distance),
            "move the light to its other side, or correct the unit, axis or place of the mesh"};
}

void judgeFrame(const Evidence& e, bool isEnclosed, Warnings& warnings) {
    constexpr double crumbs = 1e-3; // of the receivers: single pixels at the rims of triangles
    const FrameReport& frame = e.seen.report;
    if (frame.receivers + frame.facesAway == 0) return judgeEmptyView(e, warnings);
    const bool isDark = frame.shadowed > 1 - crumbs, isLit = frame.lit > 1 - crumbs;
    const bool isNothing = frame.receivers == 0 || isDark || isLit;
    if (frame.lightPoints == 0 || (!isNothing && !isFromBelow(e))) return;
    if (frame.facesAway > frame.receivers && !isEnclosed)
        warnings.push_back(mostFacesAway(e));
    else if (isLit)
        warnings.push_back({"every pixel of a receiver is lit: there is nothing to score",
                            "move the light or the camera so that a shadow falls into view, or add what casts one"});
    else if (isNothing)
        warnings.push_back(allShadowed(e, isEnclosed));
}

} // namespace

std::vector<Warning> warningsOf(const Evidence& e, const std::vector<MeshReport>& meshes) {
    Warnings warnings;
    judgeSizes(e, meshes, warnings);
    judgePrecision(e, warnings);
    judgeAxes(e, warnings);
    judgeMeshes(e, meshes, warnings);
    const bool isEnclosed = judgeEnclosure(e, warnings);
    judgeLight(e, warnings);
    judgeFrame(e, isEnclosed, warnings);
    judgeMap(e, warnings);
    return warnings;
}

} // namespace shadowbench::inspect
