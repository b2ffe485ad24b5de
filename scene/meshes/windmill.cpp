// The procedural windmill: a tower with its cap, and a rotor whose four vanes are lattices of thin bars.
#include "scene/meshes/primitives.h"
#include "scene/meshes/procedural.h"
#include "scene/meshes/solids.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench {
namespace {

constexpr double kFoot = 0.05; // metres that the tower reaches into the ground: no face lies in the ground's own plane
constexpr double kHubHeight = 2.9, kHubForward = 0.72; // metres from the tower's foot to the middle of the rotor

/// A surface of revolution of about `faces` quads: rings and sides as near to `ringsPerSide` as a close count allows.
struct Grid {
    int sides, rings;
};

Grid gridOf(int faces, int leastRings, double ringsPerSide) {
    Grid best{3, leastRings};
    double least = 1e300;
    for (int sides = 3; sides <= std::max(3, faces / leastRings + 1); ++sides) {
        const int rings = std::max(leastRings, faces / sides);
        const double miscount = std::abs(sides * rings - faces) / static_cast<double>(faces);
        const double misshape = std::abs(std::log(rings / (ringsPerSide * sides)));
        const double cost = 20 * std::max(0.0, miscount - 0.02) + misshape; // the count first, to within two per cent
        if (cost >= least) continue;
        least = cost;
        best = {sides, rings};
    }
    return best;
}

/// Tapered body with a slight waist; the last ring is the shoulder under the cap.
Mesh towerBody(int sides, int rings) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i < rings; ++i) {
        const double t = static_cast<double>(i) / (rings - 1);
        profile.emplace_back(0.78 - 0.36 * t - 0.05 * std::sin(glm::pi<double>() * t), 2.65 * t - kFoot);
    }
    return revolved(-kFoot, profile, 2.63, sides);
}

/// A dome that overhangs the body a little and sinks into it.
Mesh towerCap(int sides, int rings) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i < rings; ++i) {
        const double angle = 0.5 * glm::pi<double>() * i / rings;
        profile.emplace_back(0.53 * std::cos(angle), 2.55 + 0.85 * std::sin(angle));
    }
    return revolved(2.52, profile, 3.4, sides);
}

Mesh bar(const glm::dvec3& centre, const glm::dvec3& size, int sides) {
    if (sides == 4) {
        Mesh mesh = box(size);
        for (glm::vec3& position : mesh.positions) position += glm::vec3(centre);
        return mesh;
    }
    // A rounded bar: the round section scaled to the bar's thickness, along its longer side.
    const bool along = size.y > size.x;
    const double half = 0.5 * (along ? size.y : size.x);
    const Mesh round =
        along ? rod({0, -half, 0}, {0, half, 0}, 0.5, 0.5, sides) : rod({-half, 0, 0}, {half, 0, 0}, 0.5, 0.5, sides);
    const glm::dvec3 scale = along ? glm::dvec3(size.x, 1, size.z) : glm::dvec3(1, size.y, size.z);
    Mesh mesh{{}, {}, true};
    append(mesh, round, glm::scale(glm::translate(glm::dmat4(1), centre), scale));
    return mesh;
}

/// The vane that points along +y, of `bars` bars: a plate; a stock with plates; or a stock, laths along it and bars across.
/// Depths differ from part to part, so that no two faces lie in one plane. Gaps and bars have equal shares at every level.
Mesh vane(int bars, int sides) {
    constexpr double kRoot = 0.34, kTip = 1.62, kSail = 0.46, kLength = kTip - kRoot;
    if (bars == 1) return bar({0.12, 0.5 * (0.1 + kTip), 0}, {0.36, kTip - 0.1, 0.03}, sides);

    Mesh mesh{{}, {}, true};
    append(mesh, bar({0, 0.5 * (0.06 + kTip + 0.05), 0}, {0.07, kTip - 0.01, 0.06}, sides));
    const int laths = bars < 6 ? 0 : bars < 20 ? 2 : 4;
    for (int i = 0; i < laths; ++i) {
        const double x = laths == 2 ? -0.11 + 0.55 * i : (i == 0 ? -0.11 : kSail * i / 3.0 - 0.01);
        append(mesh, bar({x, kRoot + 0.5 * kLength, 0}, {0.028, kLength, 0.024}, sides));
    }
    const int across = bars - 1 - laths;
    const double pitch = kLength / across;
    for (int i = 0; i < across; ++i)
        append(mesh, bar({0.165, kRoot + (i + 0.5) * pitch, 0}, {kSail + 0.14, 0.5 * pitch, 0.038}, sides));
    return mesh;
}

} // namespace

Mesh windmillTower(int triangles) {
    constexpr int kAxle = 12;
    const Grid grid = gridOf((triangles - kAxle) / 2, 3, 0.6);
    const int capRings = std::max(1, grid.rings * 2 / 5);
    Mesh mesh{{}, {}, true};
    append(mesh, towerBody(grid.sides, grid.rings - capRings));
    append(mesh, towerCap(grid.sides, capRings));
    append(mesh, bar({0, kHubHeight, 0.5 * kHubForward}, {0.12, 0.13, kHubForward}, 4));
    return mesh;
}

Mesh windmillRotor(int triangles) {
    constexpr int kVanes = 4, kMostBars = 45, kLeastHub = 6;
    const auto trianglesOf = [](int bars, int sides) { return kVanes * bars * (4 * sides - 4); };
    int sides = 4, bars = std::clamp((triangles - kLeastHub) / trianglesOf(1, 4), 1, kMostBars);
    while (bars == kMostBars && trianglesOf(bars, sides + 1) + kLeastHub <= triangles) ++sides;

    // What the vanes leave goes into the hub, turned from y to the rotor's axis.
    const int rest = std::max(kLeastHub, triangles - trianglesOf(bars, sides));
    const Grid grid = gridOf(rest / 2, 1, 0.5);
    std::vector<glm::dvec2> profile;
    for (int i = 0; i < grid.rings; ++i) {
        const double angle = glm::pi<double>() * (i + 1) / (grid.rings + 1);
        profile.emplace_back(0.17 * std::sin(angle), -0.16 * std::cos(angle));
    }
    Mesh mesh{{}, {}, true};
    append(mesh, revolved(-0.16, profile, 0.16, grid.sides), glm::rotate(glm::dmat4(1), glm::half_pi<double>(), {1, 0, 0}));
    const glm::dmat4 pitch = glm::rotate(glm::dmat4(1), glm::radians(14.0), {0, 1, 0}); // of the sails to the wind
    for (int i = 0; i < kVanes; ++i)
        append(mesh, vane(bars, sides), glm::rotate(glm::dmat4(1), glm::half_pi<double>() * i, {0, 0, 1}) * pitch);
    return mesh;
}

} // namespace shadowbench
