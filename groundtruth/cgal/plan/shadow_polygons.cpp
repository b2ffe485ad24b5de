// From the light onto the plane in exact rational numbers, clipped to the receiver's box; one count of the triangles between
// the light and a point of the box anchors the winding numbers.
#include "groundtruth/cgal/plan/shadow_polygons.h"

#include "base/error.h"
#include "groundtruth/cgal/geometry/mesh_edges.h"
#include "groundtruth/cgal/geometry/primary.h"
#include "groundtruth/cgal/geometry/silhouette.h"
#include "groundtruth/cgal/geometry/vector.h"
#include "groundtruth/cgal/hard/rays.h"
#include "groundtruth/cgal/plan/plane_box.h"
#include "groundtruth/cgal/plan/shadow_polygons_plane.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

namespace shadowbench::groundtruth::plan {
namespace {

/// The receiver's bounding box in plane coordinates.
PlaneBox windowAround(const std::vector<Triangle>& receiver, const PlaneAxes& axes) {
    PlaneBox window;
    for (const Triangle& t : receiver)
        for (const glm::dvec3& v : t) window.add({v[axes.u], v[axes.v]});
    return window;
}

/// A vertex's shadow (x, y) / w in homogeneous plane coordinates; w > 0 below the light.
struct ShadowPoint {
    ExactNumber x, y, w;

    [[nodiscard]] ExactPoint point() const { return {x / w, y / w}; }
};

ShadowPoint between(const ShadowPoint& a, const ShadowPoint& b, const ExactNumber& share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.w + share * (b.w - a.w)};
}

/// Distances from the window's sides times w, positive inside. All of them are positive only where w is.
std::array<ExactNumber, 4> insets(const ShadowPoint& p, const PlaneBox& window) {
    return {p.x - window.low.x * p.w, window.high.x * p.w - p.x, p.y - window.low.y * p.w, window.high.y * p.w - p.y};
}

class PlaneProjection {
public:
    PlaneProjection(const PlaneFrame& frame, const glm::dvec4& light)
        : axes_(frame.axes), normal_(normal<ExactNumber>(frame.triangle)), origin_(vector<ExactNumber>(frame.triangle[0])),
          light_(vector<ExactNumber>(glm::dvec3(light))), lightWeight_(light.w),
          lightHeight_(dot(normal_, light.w == 0 ? light_ : light_ - origin_)) {}

    /// The plane's point H v − h l of weight H − h w_l (h and H: heights of v and of the light l above the plane).
    [[nodiscard]] ShadowPoint project(const EdgePoint& point) const {
        const Vector<ExactNumber> v = located(point);
        const ExactNumber h = heightOf(v);
        const Vector<ExactNumber> shadow = lightHeight_ * v - h * light_;
        return {shadow[axes_.u], shadow[axes_.v], weightAt(h)};
    }

private:
    [[nodiscard]] ExactNumber heightOf(const Vector<ExactNumber>& v) const { return dot(normal_, v - origin_); }

    [[nodiscard]] ExactNumber weightAt(const ExactNumber& height) const { return lightHeight_ - height * lightWeight_; }

    [[nodiscard]] Vector<ExactNumber> located(const EdgePoint& point) const {
        Vector<ExactNumber> a = vector<ExactNumber>(point.a); // not const, so that it is moved
        if (point.kind == EdgePointKind::Vertex) return a;
        const Vector<ExactNumber> b = vector<ExactNumber>(point.b);
        ExactNumber atA = heightOf(a), atB = heightOf(b);
        if (point.kind == EdgePointKind::LightContact) {
            atA = weightAt(atA);
            atB = weightAt(atB);
        }
        return a + (atA / (atA - atB)) * (b - a);
    }

    PlaneAxes axes_;
    Vector<ExactNumber> normal_, origin_, light_;
    ExactNumber lightWeight_, lightHeight_;
};

/// Collects the shadow's edges within the window. Edges that share a point share its coordinates, which spares exact
/// comparisons.
class ShadowEdges {
public:
    ShadowEdges(const PlaneFrame& frame, const glm::dvec4& light, const PlaneBox& window)
        : projection_(frame, light), window_(window), orientation_(frame.orientation) {}

    void add(const SpatialEdge& edge) {
        const Shadow &from = shadowOf(edge.from), &to = shadowOf(edge.to);
        const Covers more{orientation_ * edge.covers, 0};
        if (from.within && to.within)
            edges_.push_back({*from.within, *to.within, more});
        else
            addClipped(from, to, more);
    }

    std::vector<CoverEdge> take() { return std::move(edges_); }

private:
    struct Shadow {
        ShadowPoint position;
        std::array<ExactNumber, 4> inset;
        std::optional<ExactPoint> within; // if in the window
    };

    struct Less {
        static auto key(const EdgePoint& p) {
            const glm::dvec3 other = p.kind == EdgePointKind::Vertex ? p.a : p.b;
            return std::tuple(p.kind, p.a.x, p.a.y, p.a.z, other.x, other.y, other.z);
        }
        bool operator()(const EdgePoint& a, const EdgePoint& b) const { return key(a) < key(b); }
    };

    const Shadow& shadowOf(const EdgePoint& point) {
        const auto [found, isNew] = shadows_.try_emplace(point);
        Shadow& shadow = found->second;
        if (!isNew) return shadow;
        shadow.position = projection_.project(point);
        shadow.inset = insets(shadow.position, window_);
        if (std::ranges::all_of(shadow.inset, [](const ExactNumber& d) { return d >= 0; }))
            shadow.within = shadow.position.point();
        return shadow;
    }

    /// What runs along the window's border does not matter.
    void addClipped(const Shadow& from, const Shadow& to, const Covers& more) {
        ExactNumber first = 0, last = 1;
        for (std::size_t i = 0; i < from.inset.size(); ++i) {
            const ExactNumber &a = from.inset[i], &b = to.inset[i];
            if (a <= 0 && b <= 0) return;
            if (a < 0) first = std::max(first, ExactNumber(a / (a - b)));
            if (b < 0) last = std::min(last, ExactNumber(a / (a - b)));
        }
        if (first >= last) return;
        const ExactPoint start = from.within ? *from.within : between(from.position, to.position, first).point();
        const ExactPoint end = to.within ? *to.within : between(from.position, to.position, last).point();
        edges_.push_back({start, end, more});
    }

    PlaneProjection projection_;
    PlaneBox window_;
    int orientation_;
    std::map<EdgePoint, Shadow, Less> shadows_;
    std::vector<CoverEdge> edges_;
};

void addFence(const PlaneBox& window, std::vector<CoverEdge>& edges) {
    const std::array<ExactPoint, 4> corners{ExactPoint(window.low.x, window.low.y), ExactPoint(window.high.x, window.low.y),
                                            ExactPoint(window.high.x, window.high.y),
                                            ExactPoint(window.low.x, window.high.y)};
    for (std::size_t i = 0; i < 4; ++i) edges.push_back({corners[i], corners[(i + 1) % 4], {}, true});
}

/// Counts what covers a point of the window.
class AnchorCounter {
public:
    AnchorCounter(const SceneTriangles& scene, const hard::PlanarReceiver& receiver, const std::vector<Triangle>& triangles,
                  const PlaneFrame& frame, const glm::dvec4& light)
        : scene_(scene), name_{scene.instanceOf(receiver.id), receiver.triangles.front()}, triangles_(triangles),
          frame_(frame), light_(light) {}

    /// Nothing if the segment from the plane's point to the light touches an edge.
    [[nodiscard]] std::optional<Covers> at(const glm::dvec2& point) const {
        glm::dvec3 origin(0), direction(0);
        origin[frame_.axes.u] = point.x;
        origin[frame_.axes.v] = point.y;
        direction[frame_.axes.dropped] = 1;
        const ReceiverPoint onPlane({origin, direction}, frame_.triangle);
        const std::optional<int> shadows = hard::coverCount(scene_, onPlane, name_, light_);
        if (!shadows) return std::nullopt;
        const auto receivers = std::ranges::count_if(triangles_, [&](const Triangle& t) { return holds(t, point); });
        return Covers{*shadows, static_cast<int>(receivers)};
    }

private:
    [[nodiscard]] bool holds(const Triangle& t, const glm::dvec2& point) const {
        const ExactPoint p(point.x, point.y), a = frame_.drop(t[0]), b = frame_.drop(t[1]), c = frame_.drop(t[2]);
        const CGAL::Orientation turn = CGAL::orientation(a, b, p);
        return turn != CGAL::COLLINEAR && turn == CGAL::orientation(b, c, p) && turn == CGAL::orientation(c, a, p);
    }

    const SceneTriangles& scene_;
    TriangleName name_;
    const std::vector<Triangle>& triangles_;
    const PlaneFrame& frame_;
    const glm::dvec4& light_;
};

/// Counts from one point of the window and checks with another. The points are those of the R2 sequence, the first of which
/// that lie on no edge are taken.
void countFromAnchor(CoveredPlane& plane, const AnchorCounter& counter, const PlaneBox& window) {
    constexpr int attempts = 100;
    bool counted = false;
    for (int i = 1; i <= attempts; ++i) {
        const glm::dvec2 share =
            glm::fract(0.5 + static_cast<double>(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const glm::dvec2 point = window.low + share * (window.high - window.low);
        const std::optional<Covers> covers = counter.at(point);
        const ExactPoint exact(point.x, point.y);
        if (!covers) continue;
        if (!counted) {
            counted = plane.countFrom(exact, *covers);
            continue;
        }
        const std::optional<Covers> check = plane.at({exact}).front();
        if (!check) continue;
        if (check->first == covers->first && check->second == covers->second) return;
        throw InternalError("The winding numbers of a receiver's shadows disagree with the triangles between it and the "
                            "light; please report this scene.");
    }
    throw InternalError("No point of a planar receiver's box is clear of shadow edges; please report this scene.");
}

bool inShadow(Covers covers) {
    if (covers.first < 0)
        throw InternalError("A face of a receiver's shadows has a negative winding number; please report this scene.");
    return covers.first > 0 && covers.second > 0;
}

std::vector<CoverEdge> shadowEdges(const SceneTriangles& scene, const PlaneFrame& frame, const glm::dvec4& light,
                                   const PlaneBox& window) {
    ShadowEdges shadows(frame, light, window);
    std::map<std::size_t, MeshEdges> meshEdges; // by tree: once for all instances of a mesh
    for (const TriangleInstance& instance : scene.instances()) {
        const auto [edges, isNew] = meshEdges.try_emplace(instance.tree);
        if (isNew) edges->second = MeshEdges(*instance.mesh);
        for (const ChainEdge& edge : clippedChains(instance, edges->second, light, frame.triangle, 1).edges)
            if (edge.covers != 0 && !edge.atLightLevel) shadows.add(spatialEdge(instance, edge)); // others lie at infinity
    }
    return shadows.take();
}

std::optional<glm::dvec2> footOf(const Light& light, const PlaneFrame& frame) {
    if (light.kind != LightKind::Point) return std::nullopt;
    const Triangle& t = frame.triangle;
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const glm::dvec3 foot = light.centre - glm::dot(normal, light.centre - t[0]) * normal;
    return glm::dvec2(foot[frame.axes.u], foot[frame.axes.v]);
}

ShadowPolygons shadowsOn(const SceneTriangles& scene, const Snapshot& snapshot, const hard::PlanarReceiver& receiver) {
    const glm::dvec4 light = snapshot.light.homogeneous();
    const std::vector<Triangle> triangles = receiverTriangles(snapshot, receiver);
    const PlaneFrame frame(triangles.front(), light);
    const PlaneBox window = windowAround(triangles, frame.axes);

    std::vector<CoverEdge> edges = shadowEdges(scene, frame, light, window);
    const std::vector<CoverEdge> outline = receiverEdges(triangles, frame);
    edges.insert(edges.end(), outline.begin(), outline.end());
    addFence(window, edges);

    CoveredPlane plane(edges);
    countFromAnchor(plane, AnchorCounter(scene, receiver, triangles, frame, light), window);
    return {rounded(receiver.id, frame.axes, plane.where([](Covers c) { return c.second > 0; })),
            rounded(receiver.id, frame.axes, plane.where(inShadow)), footOf(snapshot.light, frame)};
}

/// Where the rays of pixel centres meet a plane.
class ExactPixels {
public:
    ExactPixels(const Camera& camera, glm::ivec2 size, const Triangle& plane, const PlaneAxes& axes)
        : camera_(camera), size_(size), axes_(axes), normal_(normal<ExactNumber>(plane)),
          origin_(vector<ExactNumber>(plane[0])) {}

    [[nodiscard]] ExactPoint receiverPoint(int x, int y) const {
        const Ray ray = pixelRay(camera_, x, y, size_);
        const Vector<ExactNumber> from = vector<ExactNumber>(ray.origin), direction = vector<ExactNumber>(ray.direction);
        const ExactNumber depth = dot(normal_, origin_ - from) / dot(normal_, direction);
        return {from[axes_.u] + depth * direction[axes_.u], from[axes_.v] + depth * direction[axes_.v]};
    }

private:
    const Camera& camera_;
    glm::ivec2 size_;
    PlaneAxes axes_;
    Vector<ExactNumber> normal_, origin_;
};

bool sees(const PrimaryHits& primary, int x, int y, const hard::PlanarReceiver& receiver) {
    return primary.surface(x, y) == Surface::Receiver && primary.id(x, y) == receiver.id &&
           std::ranges::binary_search(receiver.triangles, primary.triangle(x, y));
}

void label(const std::vector<glm::ivec2>& pixels, const ExactPixels& exact, const ReceiverRegion& shadow, Reference& out) {
    std::vector<ExactPoint> points;
    for (const glm::ivec2& pixel : pixels) points.push_back(exact.receiverPoint(pixel.x, pixel.y));
    const std::vector<Location> locations = locate(*shadow.exact, points);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto [x, y] = std::pair(pixels[i].x, pixels[i].y);
        out.visibility(x, y) = locations[i] == Location::Inside ? 0.0F : 1.0F;
        out.surface(x, y) = locations[i] == Location::OnBorder ? Surface::OnEdge : Surface::Receiver;
    }
}

} // namespace

std::vector<ShadowPolygons> shadowPolygons(const Snapshot& snapshot, const std::vector<hard::PlanarReceiver>& receivers) {
    if (snapshot.light.isArea())
        throw InternalError("Shadow polygons were asked for an area light; use Light::centreOnly for its centre.");
    const SceneTriangles scene(snapshot);
    std::vector<ShadowPolygons> result;
    for (const hard::PlanarReceiver& receiver : receivers) result.push_back(shadowsOn(scene, snapshot, receiver));
    return result;
}

double differingArea(const ReceiverRegion& a, const ReceiverRegion& b) {
    std::vector<CoverEdge> edges;
    addBorder(*a.exact, {1, 0}, edges);
    addBorder(*b.exact, {0, 1}, edges);
    CoveredPlane plane(edges);
    plane.countFromOutside();
    return areaOf(plane.where([](Covers c) { return (c.first > 0) != (c.second > 0); }));
}

void labelByRegion(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary,
                   const hard::PlanarReceiver& receiver, const ReceiverRegion& shadow, Reference& out) {
    if (!out.visibility.sameSize(primary.id) || !out.surface.sameSize(primary.id) || primary.id.width() != size.x ||
        primary.id.height() != size.y)
        throw InternalError("Labels by polygons were asked for images of different sizes.");
    const ExactPixels exact(snapshot.camera, size, receiverTriangles(snapshot, receiver).front(), shadow.axes);
    constexpr int band = 64; // rows: bounds the memory that exact points take
    for (int top = 0; top < size.y; top += band) {
        std::vector<glm::ivec2> pixels;
        for (int y = top; y < std::min(size.y, top + band); ++y)
            for (int x = 0; x < size.x; ++x)
                if (sees(primary, x, y, receiver)) pixels.emplace_back(x, y);
        label(pixels, exact, shadow, out);
    }
}

} // namespace shadowbench::groundtruth::plan
