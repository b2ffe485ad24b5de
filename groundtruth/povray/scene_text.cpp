// Scene text for POV-Ray. Everything in it is a number or a word of ours: no string of the user's gets into it.
#include "groundtruth/povray/scene_text.h"

#include "groundtruth/povray/povray.h"

#include "base/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <map>

namespace shadowbench::groundtruth::povray {
namespace {

constexpr double largestCoordinate = 1e7; // POV-Ray's MAX_DISTANCE

void addCamera(Text& text, const Camera& camera, glm::ivec2 size, double scale) {
    const Camera::Basis basis = camera.basis();
    const double height = 2 * std::tan(0.5 * glm::radians(camera.fovy));
    const double aspect = static_cast<double>(size.x) / size.y;
    add(text, "camera {{ perspective location {} direction {} right {} up {} }}\n", vector(scale * camera.eye),
        vector(basis.forward), vector(height * aspect * basis.right), vector(height * basis.up));
}

void addMesh(Text& text, const Mesh& mesh, std::size_t number) {
    add(text, "#declare M{} = mesh2 {{\nvertex_vectors {{ {}", number, mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) add(text, ",\n{}", vector(p));
    add(text, "\n}}\nface_indices {{ {}", mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) add(text, ",\n<{},{},{}>", t.x, t.y, t.z);
    add(text, "\n}}\n}}\n");
}

/// POV-Ray multiplies row vectors, so its twelve numbers are the columns of our matrix one after the other.
void addPlacement(Text& text, const glm::dmat4& world, std::size_t mesh, double scale, bool doubleIlluminate) {
    add(text, "object {{ M{} matrix <", mesh);
    for (int column = 0; column < 4; ++column) {
        const std::string numbers = vector(scale * glm::dvec3(world[column]));
        add(text, "{}{}", column == 0 ? "" : ",", numbers.substr(1, numbers.size() - 2));
    }
    add(text, "> texture {{ T }}{} }}\n", doubleIlluminate ? " double_illuminate" : "");
}

/// One point light a sample; the parts of the set in red, green and blue.
void addPoints(Text& text, const Light& light, int samples, double scale) {
    const SampleParts parts = sampleParts(samples);
    const double quarter = 1.0 / std::bit_ceil(static_cast<unsigned>(parts.firstQuarter));
    const double half = hitMask / std::bit_ceil(static_cast<unsigned>(parts.secondHalf));
    for (int i = 0; i < samples; ++i) {
        const glm::dvec3 colour = i < parts.firstQuarter                         ? glm::dvec3(quarter, 0, 0)
                                  : i < parts.firstQuarter + parts.secondQuarter ? glm::dvec3(0, quarter, 0)
                                                                                 : glm::dvec3(0, 0, half);
        add(text, "light_source {{ {} rgb {} }}\n", vector(scale * light.sample(lightSample(i, samples))), vector(colour));
    }
}

/// Lights along a side of a square grid.
int gridSide(int samples) { return static_cast<int>(std::lround(std::sqrt(samples))); }

/// An area_light spans its own outermost lights: (n − 1)/n puts them at the centres of n × n cells.
void addGrid(Text& text, const Light& light, glm::ivec2 lights, const glm::dvec3& colour, double scale, bool adaptive) {
    const glm::dvec2 share = 1.0 - 1.0 / glm::dvec2(lights);
    add(text, "light_source {{ {} rgb {} area_light {}, {}, {}, {}{} }}\n", vector(scale * light.centre), vector(colour),
        vector(scale * share.x * light.u), vector(scale * share.y * light.v), lights.x, lights.y,
        adaptive ? " adaptive 1" : "");
}

void addLights(Text& text, const Light& light, int samples, double scale, const Recipe& recipe) {
    if (recipe.lights == Recipe::Lights::Points) return addPoints(text, light, samples, scale);
    const bool adaptive = recipe.lights == Recipe::Lights::AdaptiveGrid;
    const int n = gridSide(samples);
    addGrid(text, light, {n / 2, n / 2}, {1, 0, 0}, scale, adaptive);
    addGrid(text, light, {n / 2, n}, {0, 1, 0}, scale, adaptive);
    addGrid(text, light, {n, n}, {0, 0, 1 - hitMask}, scale, adaptive);
}

void requireGrid(const Light& light, int samples) {
    constexpr int fewestAlongASide = 4;
    const int n = gridSide(samples);
    if (light.kind != LightKind::Rectangle || n * n != samples || n < fewestAlongASide)
        throw BadInput(fmt::format("a grid of {} light samples on a {} light: give a rectangle and a square number of at "
                                   "least {} samples",
                                   samples, name(light.kind), fewestAlongASide * fewestAlongASide));
}

void requireRenderable(const Snapshot& snapshot, glm::ivec2 size, int samples, const Recipe& recipe) {
    if (!snapshot.light.isArea())
        throw BadInput(fmt::format("the povray oracle samples area lights, and this light is {}: use polygon or rays",
                                   name(snapshot.light.kind)));
    if (samples < fewestLightSamples || samples > mostLightSamples)
        throw BadInput(
            fmt::format("{} light samples asked for: give {} to {}", samples, fewestLightSamples, mostLightSamples));
    if (size.x < 1 || size.y < 1) throw BadInput(fmt::format("an image of {} × {} pixels has none", size.x, size.y));
    if (recipe.lights != Recipe::Lights::Points) requireGrid(snapshot.light, samples);
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

} // namespace

std::string vector(const glm::dvec3& v) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        throw BadInput("cannot write the POV-Ray scene: a position or a placement is not finite; correct the scene");
    return fmt::format("<{:.17g},{:.17g},{:.17g}>", v.x, v.y, v.z);
}

double scaleFor(const Snapshot& snapshot, double lights, double largestScale) {
    double world = std::max(largest(snapshot.camera.eye), lights);
    if (const Bounds bounds = snapshot.bounds(); !bounds.empty())
        world = std::max({world, largest(bounds.low), largest(bounds.high)});
    double scale = largestScale;
    while (scale * world >= largestCoordinate && std::isfinite(world)) scale /= 2;
    return scale;
}

double scaleOf(const Snapshot& snapshot, const Recipe& recipe) {
    const Light& light = snapshot.light;
    return scaleFor(snapshot, largest(light.centre) + 0.5 * (largest(light.u) + largest(light.v)), recipe.largestScale);
}

void addScene(Text& text, const Snapshot& snapshot, glm::ivec2 size, const Surfaces& surfaces) {
    add(text, "#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 }}\n");
    add(text,
        "#declare T = texture {{ pigment {{ rgb 1 }} "
        "finish {{ ambient 0 diffuse 1 brilliance {} emission rgb <0,0,{}> }} }}\n",
        surfaces.brilliance, hitMask);
    addCamera(text, snapshot.camera, size, surfaces.scale);

    std::map<const Mesh*, std::size_t> numbers;
    for (const Batch& batch : snapshot.batches) {
        const auto [entry, isNew] = numbers.try_emplace(batch.mesh.get(), numbers.size());
        if (isNew) addMesh(text, *batch.mesh, entry->second);
        for (const Placement& placement : batch.placements)
            addPlacement(text, placement.world, entry->second, surfaces.scale, surfaces.doubleIlluminate);
    }
}

std::string sceneText(const Snapshot& snapshot, glm::ivec2 size, int samples, const Recipe& recipe) {
    requireRenderable(snapshot, size, samples, recipe);
    const double scale = scaleOf(snapshot, recipe);
    Text text;
    addScene(text, snapshot, size, {scale, 0, recipe.doubleIlluminate}); // no brilliance: the diffuse term is constant
    addLights(text, snapshot.light, samples, scale, recipe);
    return fmt::to_string(text);
}

} // namespace shadowbench::groundtruth::povray
