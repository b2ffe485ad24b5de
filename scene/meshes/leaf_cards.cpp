// Foliage as games have it: cards that show a spray of leaves where their texture's alpha is solid.
#include "base/random.h"
#include "scene/meshes/alpha_mask.h"
#include "scene/meshes/procedural.h"
#include "scene/meshes/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace shadowbench {
namespace {

struct Ellipse {
    glm::dvec2 centre, along; // of the card; half its length
    double width = 0;         // half, as a share of the length

    /// 1 at the centre, ½ at the border.
    [[nodiscard]] double alphaAt(const glm::dvec2& place) const {
        const double length = glm::length(along);
        const glm::dvec2 direction = along / length, from = place - centre;
        const double x = glm::dot(from, direction) / length,
                     y = (from.x * direction.y - from.y * direction.x) / (width * length);
        return 1 - 0.5 * std::sqrt(x * x + y * y);
    }
};

/// A twig from the foot of the card to its head, leaves in pairs and one at its end.
std::vector<Ellipse> spray() {
    constexpr int pairs = 4;
    std::vector<Ellipse> parts{{{0.5, 0.45}, {0, 0.42}, 0.022}, {{0.5, 0.87}, {0, 0.11}, 0.5}};
    for (int i = 0; i < pairs; ++i) {
        const glm::dvec2 joint(0.5, 0.14 + 0.17 * i);
        for (const double side : {-1.0, 1.0}) {
            const double angle = glm::radians(38.0 + 3.0 * i + 2.0 * side), length = 0.165 - 0.012 * i;
            const glm::dvec2 along = length * glm::dvec2(side * std::cos(angle), std::sin(angle));
            parts.push_back({joint + 1.08 * along, along, 0.42});
        }
    }
    return parts;
}

/// As a texture of 8 bits has it, read as scene/meshes/gltf_masks.cpp reads one: exported cards have the very same outline.
float inBytes(double alpha) {
    constexpr float scale = 1.0F / 255.0F;
    return scale * static_cast<float>(std::lround(255 * alpha));
}

AlphaMask sprayMask(int texels, double cutoff) {
    AlphaMask mask{Image<float>(texels, texels), cutoff, false, AlphaMask::Wrap::Clamp, AlphaMask::Wrap::Clamp};
    const std::vector<Ellipse> parts = spray();
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / static_cast<double>(texels);
            double alpha = 0;
            for (const Ellipse& part : parts) alpha = std::max(alpha, part.alphaAt(place));
            mask.alpha(x, y) = inBytes(alpha);
        }
    return mask;
}

glm::dvec3 nextDirection(Random& random) {
    const double s = random.uniform();
    return directionOf(s, random.uniform());
}

} // namespace

Mesh leafCards(int count, double size, int texels, double cutoff, std::uint32_t seed) {
    const Mesh card{{{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {-0.5, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    constexpr std::array<glm::vec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    MaskedMesh cards{{}, {}, std::make_shared<const AlphaMask>(sprayMask(texels, cutoff))};
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 outward = nextDirection(random), foot = (1 - size) * std::cbrt(random.uniform(0.1, 1)) * outward;
        const glm::dvec3 up = glm::normalize(outward + 0.6 * nextDirection(random));
        const glm::dvec3 right = glm::normalize(glm::cross(up, nextDirection(random)));
        append(cards.mesh, card,
               glm::dmat4(glm::dvec4(size * right, 0), glm::dvec4(size * up, 0), glm::dvec4(size * glm::cross(right, up), 0),
                          glm::dvec4(foot, 1)));
        cards.uv.insert(cards.uv.end(), corners.begin(), corners.end());
    }
    Mesh crown = weld(cutByMask(cards));
    crown.cards = std::make_shared<const MaskedMesh>(std::move(cards));
    return crown;
}

} // namespace shadowbench
