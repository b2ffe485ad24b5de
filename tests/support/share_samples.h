// Shares of an area light by random points of it: what the exact ones are compared with. No closed form, silhouette or
// arithmetic is shared with these.
#pragma once

#include "base/random.h"
#include "groundtruth/cgal/area/area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowbench::groundtruth {

constexpr std::array sampledShares{area::Share::Area, area::Share::Irradiance, area::Share::SolidAngle};

/// Light points are drawn evenly over the area and kept with a probability in proportion to what they weigh, so that of N
/// that are kept the number of visible ones is binomial, with the share as its probability.
class ShareSampler {
public:
    /// `normal`: of the receiver, on the side of the light; of length 1. The light's sides are at right angles.
    ShareSampler(const Light& light, const glm::dvec3& point, const glm::dvec3& normal)
        : light_(light), point_(point), normal_(normal), axis_(glm::normalize(glm::cross(light.u, light.v))),
          distance_(std::abs(glm::dot(light.centre - point, axis_))) {
        glm::dvec3 nearest = light.centre;
        double height = glm::dot(light.centre - point, normal);
        for (const glm::dvec3& side : {light.u, light.v}) {
            nearest += std::clamp(glm::dot(point - light.centre, side) / glm::dot(side, side), -0.5, 0.5) * side;
            height += 0.5 * std::abs(glm::dot(side, normal));
        }
        const double least = glm::distance(nearest, point) * (1 - 1e-9);
        mostSolidAngle_ = distance_ / (least * least * least);
        mostIrradiance_ = height * (1 + 1e-9) * mostSolidAngle_ / least;
    }

    /// How many of `samples` points are visible, by each of `sampledShares`. `visible(points, seen)` is asked for many
    /// points at a time and sets each `seen` to 1 or 0.
    template <typename Visible>
    std::array<int, 3> visibleOf(int samples, std::uint64_t seed, const Visible& visible) const {
        Random random(seed);
        std::array<int, 3> kept{}, seen{};
        while (std::ranges::min(kept) < samples) {
            std::vector<glm::dvec3> points;
            std::vector<std::array<bool, 3>> keeps;
            std::array<int, 3> drawn = kept;
            while (points.size() < 1024 && std::ranges::min(drawn) < samples) {
                const double s = random.uniform(), t = random.uniform();
                const glm::dvec3 point = light_.sample({s, t});
                std::array<bool, 3> keep{};
                for (std::size_t i = 0; i < 3; ++i) {
                    keep[i] = random.uniform() < chance(sampledShares[i], point) && drawn[i] < samples;
                    drawn[i] += keep[i] ? 1 : 0;
                }
                if (keep == std::array{false, false, false}) continue;
                points.push_back(point);
                keeps.push_back(keep);
            }
            std::vector<char> found(points.size());
            visible(points, found);
            for (std::size_t p = 0; p < points.size(); ++p)
                for (std::size_t i = 0; i < 3; ++i) seen[i] += keeps[p][i] && found[p] != 0 ? 1 : 0;
            kept = drawn;
        }
        return seen;
    }

private:
    [[nodiscard]] double chance(area::Share share, const glm::dvec3& on) const {
        if (share == area::Share::Area) return 1;
        const glm::dvec3 towards = on - point_;
        const double r = glm::length(towards), cosineAtLight = std::abs(glm::dot(towards, axis_)) / r;
        const double solidAngle = cosineAtLight / (r * r);
        if (share == area::Share::SolidAngle) return solidAngle / mostSolidAngle_;
        return solidAngle * glm::dot(towards, normal_) / r / mostIrradiance_;
    }

    const Light& light_;
    glm::dvec3 point_, normal_, axis_;
    double distance_;
    double mostSolidAngle_, mostIrradiance_; // per area
};

/// The standard deviation of a share found by that many points, of which each counts whole.
inline double sampledSigma(double share, int samples) { return std::sqrt(share * (1 - share) / samples) + 1.0 / samples; }

} // namespace shadowbench::groundtruth
