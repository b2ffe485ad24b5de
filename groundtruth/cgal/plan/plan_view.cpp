// Footprints are cross-sections of the meshes half-way between receiver and light. The free plan around them is the
// environment of a visibility polygon.
#include "groundtruth/cgal/plan/plan_view.h"

#include "base/error.h"
#include "groundtruth/cgal/plan/shadow_polygons_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>
#include <string>
#include <utility>

namespace shadowbench::groundtruth::plan {
namespace {

[[noreturn]] void refuse(std::uint32_t id, const std::string& reason) {
    throw BadInput("The scene is no plan view for 2-D visibility: surface " + std::to_string(id) + " " + reason + ".");
}

/// The heights between which casters must be upright.
struct Storey {
    double floor, light;

    [[nodiscard]] int level(const glm::dvec3& v) const { return v.y <= floor ? -1 : v.y >= light ? 1 : 0; }
    [[nodiscard]] ExactNumber middle() const { return (ExactNumber(floor) + ExactNumber(light)) / 2; }
};

bool horizontal(const Triangle& t) { return t[0].y == t[1].y && t[0].y == t[2].y; }

ExactPoint inPlan(const glm::dvec3& v) { return {v.x, v.z}; }

bool vertical(const Triangle& t) { return CGAL::collinear(inPlan(t[0]), inPlan(t[1]), inPlan(t[2])); }

/// Cuts the meshes of a snapshot.
class FootprintCutter {
public:
    explicit FootprintCutter(const Storey& storey) : storey_(storey), cut_(storey.middle()) {}

    void add(const Mesh& mesh, const Placement& placement) {
        std::vector<glm::dvec3> vertices;
        for (const glm::vec3& position : mesh.positions) vertices.push_back(worldVertex(placement.world, position));
        const auto at = [&](int level) {
            return std::ranges::any_of(vertices, [&](const glm::dvec3& v) { return storey_.level(v) == level; });
        };
        if (at(0))
            refuse(placement.id, "has a vertex between the receiver and the height of the light; it must reach from one to "
                                 "the other");
        if (!at(-1) || !at(1)) return; // all of it lies above the light or below the receiver
        if (!mesh.closed) refuse(placement.id, "is not closed, so it has no footprint");
        const bool mirrored = glm::determinant(glm::dmat3(placement.world)) < 0;
        for (const glm::uvec3& t : mesh.triangles)
            addCut({vertices[t.x], vertices[t.y], vertices[t.z]}, mirrored, placement.id);
    }

    std::vector<CoverEdge> take() { return std::move(edges_); }

private:
    /// Drawn with x right and z up, the inside lies to the left of the way from the edge that goes up to the one that goes
    /// down, if the triangle is counter-clockwise seen from outside.
    void addCut(const Triangle& t, bool mirrored, std::uint32_t id) {
        ExactPoint up, down;
        bool crosses = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
            if (storey_.level(a) == storey_.level(b)) continue;
            crosses = true;
            (storey_.level(a) < 0 ? up : down) = crossing(a, b);
        }
        if (!crosses) return;
        if (!vertical(t)) refuse(id, "has a slanting face between the receiver and the height of the light");
        edges_.push_back({up, down, {mirrored ? -1 : 1, 0}});
    }

    [[nodiscard]] ExactPoint crossing(const glm::dvec3& a, const glm::dvec3& b) const {
        if (a.x == b.x && a.z == b.z) return inPlan(a);
        const ExactNumber share = (cut_ - a.y) / (ExactNumber(b.y) - a.y);
        return inPlan(a) + share * (inPlan(b) - inPlan(a));
    }

    Storey storey_;
    ExactNumber cut_;
    std::vector<CoverEdge> edges_;
};

ExactRegion footprintsOf(const Snapshot& snapshot, const Storey& storey) {
    FootprintCutter cutter(storey);
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) cutter.add(*batch.mesh, placement);
    CoveredPlane plane(cutter.take());
    plane.countFromOutside();
    return plane.where([](Covers c) { return c.first != 0; });
}

/// A box around the receiver, the light and all footprints that none of them touches: everything between the light and the
/// receiver lies in it.
std::vector<CoverEdge> boxAround(const std::vector<CoverEdge>& edges, const ExactPoint& light) {
    CGAL::Bbox_2 box = light.bbox();
    for (const CoverEdge& edge : edges) box += edge.from.bbox();
    const double low[2] = {std::floor(box.xmin()) - 1, std::floor(box.ymin()) - 1};
    const double high[2] = {std::ceil(box.xmax()) + 1, std::ceil(box.ymax()) + 1};
    const std::array<ExactPoint, 4> corners{ExactPoint(low[0], low[1]), ExactPoint(high[0], low[1]),
                                            ExactPoint(high[0], high[1]), ExactPoint(low[0], high[1])};
    std::vector<CoverEdge> result;
    for (std::size_t i = 0; i < 4; ++i) result.push_back({corners[i], corners[(i + 1) % 4], {}});
    return result;
}

/// The border of what the light sees, to whose left it lies, as `first`.
std::vector<CoverEdge> visibleEdges(const ExactRegion& footprints, const std::vector<CoverEdge>& receiver,
                                    const ExactPoint& light) {
    std::vector<CoverEdge> walls;
    addBorder(footprints, {}, walls);
    std::vector<CoverEdge> all = walls;
    all.insert(all.end(), receiver.begin(), receiver.end());
    const std::vector<CoverEdge> box = boxAround(all, light);
    walls.insert(walls.end(), box.begin(), box.end());

    const std::optional<ExactRing> seen = CoveredPlane(walls).visibleFrom(light);
    if (!seen) throw BadInput("The scene is no plan view for 2-D visibility: the light stands exactly on a wall; move it.");
    std::vector<CoverEdge> edges;
    addBorder({{{*seen, {}}}}, {1, 0}, edges);
    return edges;
}

Storey storeyOf(const Snapshot& snapshot, const std::vector<Triangle>& receiver, std::uint32_t id) {
    if (snapshot.light.kind != LightKind::Point)
        throw BadInput("2-D visibility needs a point light; this scene has a " + std::string(name(snapshot.light.kind)) +
                       " light.");
    const Storey storey{receiver.front()[0].y, snapshot.light.centre.y};
    if (!std::ranges::all_of(receiver, horizontal)) refuse(id, "is a receiver that is not horizontal");
    if (storey.light <= storey.floor) refuse(id, "is a receiver that does not lie below the light");
    return storey;
}

} // namespace

std::vector<hard::PlanarReceiver> planReceivers(const Snapshot& snapshot,
                                                const std::vector<hard::PlanarReceiver>& receivers) {
    std::vector<hard::PlanarReceiver> result;
    for (const hard::PlanarReceiver& receiver : receivers)
        if (std::ranges::all_of(receiverTriangles(snapshot, receiver), horizontal)) result.push_back(receiver);
    return result;
}

PlanView planView(const Snapshot& snapshot, const hard::PlanarReceiver& receiver) {
    const std::vector<Triangle> triangles = receiverTriangles(snapshot, receiver);
    const Storey storey = storeyOf(snapshot, triangles, receiver.id);
    const PlaneFrame frame(triangles.front(), snapshot.light.homogeneous());
    const ExactPoint light = inPlan(snapshot.light.centre);

    ExactRegion footprints = footprintsOf(snapshot, storey);
    if (locate(footprints, {light}).front() == Location::Inside)
        throw BadInput("The scene is no plan view for 2-D visibility: the light stands in a column or a wall; move it.");
    const std::vector<CoverEdge> outline = receiverEdges(triangles, frame);
    std::vector<CoverEdge> edges = visibleEdges(footprints, outline, light);
    edges.insert(edges.end(), outline.begin(), outline.end());
    CoveredPlane plane(edges);
    plane.countFromOutside();

    const auto region = [&](const auto& inside) { return rounded(receiver.id, frame.axes, plane.where(inside)); };
    return {region([](Covers c) { return c.second > 0; }), rounded(receiver.id, frame.axes, std::move(footprints)),
            region([](Covers c) { return c.second > 0 && c.first > 0; }),
            region([](Covers c) { return c.second > 0 && c.first == 0; }),
            glm::dvec2(snapshot.light.centre.x, snapshot.light.centre.z)};
}

void labelByPlan(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary, const hard::PlanarReceiver& receiver,
                 Reference& out) {
    labelByRegion(snapshot, size, primary, receiver, planView(snapshot, receiver).shadow, out);
}

} // namespace shadowbench::groundtruth::plan
