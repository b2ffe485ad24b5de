#include "groundtruth/cgal/hard/planar.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::hard {
namespace {

/// A visible receiver triangle and how many pixels see it.
struct SeenTriangle {
    std::uint32_t id, triangle;
    std::size_t pixels;
};

bool same(const SeenTriangle& a, const SeenTriangle& b) { return a.id == b.id && a.triangle == b.triangle; }

std::vector<SeenTriangle> seenTriangles(const PrimaryHits& primary) {
    std::vector<SeenTriangle> runs; // of neighbouring pixels that see the same triangle
    for (std::size_t i = 0; i < primary.id.size(); ++i) {
        if (primary.surface[i] != Surface::Receiver) continue;
        const SeenTriangle next{primary.id[i], primary.triangle[i], 1};
        if (!runs.empty() && same(runs.back(), next))
            ++runs.back().pixels;
        else
            runs.push_back(next);
    }
    std::ranges::sort(runs, {}, [](const SeenTriangle& s) { return std::pair(s.id, s.triangle); });
    std::vector<SeenTriangle> seen;
    for (const SeenTriangle& run : runs) {
        if (!seen.empty() && same(seen.back(), run))
            seen.back().pixels += run.pixels;
        else
            seen.push_back(run);
    }
    return seen;
}

/// A plane found so far. `key` is nearly the same for triangles of one plane and different for most others.
struct Group {
    double key;
    Triangle representative;
    PlanarReceiver receiver;
};

double planeKey(const Triangle& t, const glm::dvec3& eye) {
    glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    if (glm::dot(normal, eye - t[0]) < 0) normal = -normal;
    return glm::dot(normal, glm::dvec3(0.91, 0.37, 0.53) + t[0]);
}

bool inPlane(const Triangle& plane, const Triangle& t) {
    return std::ranges::all_of(t, [&](const glm::dvec3& v) { return side(plane, glm::dvec4(v, 1)) == 0; });
}

struct KeyedTriangle {
    double key;
    SeenTriangle seen;
    Triangle triangle;
};

/// Groups the triangles of one surface by exact plane.
void groupSurface(std::vector<KeyedTriangle>& triangles, std::size_t minimumPixels, std::vector<PlanarReceiver>& result) {
    std::ranges::sort(triangles, {}, [](const KeyedTriangle& t) { return std::pair(t.key, t.seen.triangle); });
    std::vector<Group> groups;
    for (const KeyedTriangle& t : triangles) {
        const double farthest = t.key - 1e-9 * (1 + std::abs(t.key)); // keys of one plane differ by rounding only
        auto group = groups.rbegin();
        while (group != groups.rend() && group->key >= farthest && !inPlane(group->representative, t.triangle)) ++group;
        if (group == groups.rend() || group->key < farthest) {
            groups.push_back({t.key, t.triangle, {t.seen.id, {}, 0}});
            group = groups.rbegin();
        }
        group->receiver.triangles.push_back(t.seen.triangle);
        group->receiver.pixels += t.seen.pixels;
    }
    for (Group& group : groups) {
        if (group.receiver.pixels < minimumPixels) continue;
        std::ranges::sort(group.receiver.triangles);
        result.push_back(std::move(group.receiver));
    }
}

} // namespace

std::vector<PlanarReceiver> findPlanarReceivers(const SceneTriangles& scene, const glm::dvec3& eye,
                                                const PrimaryHits& primary, std::size_t minimumPixels) {
    std::vector<PlanarReceiver> result;
    std::vector<KeyedTriangle> surface;
    for (const SeenTriangle& seen : seenTriangles(primary)) {
        if (!surface.empty() && surface.front().seen.id != seen.id) {
            groupSurface(surface, minimumPixels, result);
            surface.clear();
        }
        const Triangle triangle = scene.triangle({scene.instanceOf(seen.id), seen.triangle});
        surface.push_back({planeKey(triangle, eye), seen, triangle});
    }
    groupSurface(surface, minimumPixels, result);
    return result;
}

} // namespace shadowbench::groundtruth::hard
