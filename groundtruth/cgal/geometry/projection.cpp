#include "groundtruth/cgal/geometry/projection.h"

#include "groundtruth/cgal/geometry/arithmetic.h"
#include "groundtruth/cgal/geometry/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace shadowbench::groundtruth::geometry {
namespace {

bool holdsZero(const Interval& value) { return value.inf() <= 0 && value.sup() >= 0; }

} // namespace

struct ShadowProjection::Map {
    Vector<Interval> normal, origin, light, eye;
    Interval lightWeight, lightHeight;
    Vector<Interval> rowX, rowY, rowW; // pixel coordinates of an offset from the eye

    [[nodiscard]] Interval heightOf(const Vector<Interval>& v) const { return dot(normal, v - origin); }

    /// The plane's point H v − h l of weight H − h w_l, seen from the eye.
    [[nodiscard]] ShadowVertex project(const Vector<Interval>& v) const {
        const Interval h = heightOf(v);
        const Interval weight = lightHeight - h * lightWeight;
        const Vector<Interval> offset = (lightHeight * v - h * light) - weight * eye;
        const Vector<Interval> image{dot(rowX, offset), dot(rowY, offset), dot(rowW, offset)};
        ShadowVertex result{};
        for (int i = 0; i < 3; ++i) {
            result.position[i] = 0.5 * (image[i].inf() + image[i].sup());
            result.error[i] = image[i].sup() - image[i].inf();
        }
        result.lightSide = 0.5 * (weight.inf() + weight.sup());
        return result;
    }
};

ShadowProjection::ShadowProjection(const Triangle& receiver, const glm::dvec4& light, const Camera& camera, glm::ivec2 size)
    : receiver_(facing(receiver, light)), map_(std::make_unique<Map>()) {
    const Camera::Basis basis = camera.basis();
    const double tangent = std::tan(0.5 * glm::radians(camera.fovy));
    const double aspect = static_cast<double>(size.x) / size.y;

    // Camera::ray is forward + x right + y up with x and y from the pixel; it rounds each of them and the sum a few times.
    const double reach = 1 + tangent * (1 + aspect);
    pixelError_ = 64 * 0x1p-53 * reach * std::max(size.x, size.y) / (tangent * std::min(1.0, aspect)) +
                  16 * 0x1p-53 * std::max(size.x, size.y);

    const Interval::Protector rounding;
    Map& m = *map_;
    m.origin = vector<Interval>(receiver_[0]);
    m.normal = normal<Interval>(receiver_);
    m.light = vector<Interval>(glm::dvec3(light));
    m.lightWeight = Interval(light.w);
    m.lightHeight = dot(m.normal, light.w == 0 ? m.light : m.light - m.origin);
    m.eye = vector<Interval>(camera.eye);

    // The dual basis: an offset s (forward + x right + y up) has products s x, s y and s with these, times a positive
    // constant.
    const Vector<Interval> right = vector<Interval>(basis.right), up = vector<Interval>(basis.up),
                           forward = vector<Interval>(basis.forward);
    const Vector<Interval> dualX = cross(forward, up), dualY = cross(right, forward), dualW = cross(up, right);
    const Interval halfWidth(0.5 * size.x), halfHeight(0.5 * size.y);
    const Interval scaleX = Interval(1) / (Interval(tangent) * Interval(aspect)), scaleY = Interval(-1) / Interval(tangent);
    m.rowX = halfWidth * (scaleX * dualX + dualW);
    m.rowY = halfHeight * (scaleY * dualY + dualW);
    m.rowW = dualW;
    findBorders(size);
}

/// Map::project as linear functions of the vertex, and of these what is negative beyond a border.
void ShadowProjection::findBorders(glm::ivec2 size) {
    const Map& m = *map_;
    struct Linear {
        Vector<Interval> slope;
        Interval offset;
    };
    const Vector<Interval> toLight = m.light - m.lightWeight * m.eye, start = m.origin - m.eye;
    const auto image = [&](const Vector<Interval>& row) {
        return Linear{m.lightHeight * row - dot(row, toLight) * m.normal, m.lightHeight * dot(row, start)};
    };
    const Linear x = image(m.rowX), y = image(m.rowY), w = image(m.rowW);
    const auto plus = [](const Linear& a, double factor, const Linear& b) {
        return Linear{a.slope + Interval(factor) * b.slope, a.offset + Interval(factor) * b.offset};
    };
    const auto minus = [](const Linear& a) { return Linear{-a.slope, -a.offset}; };
    const std::array<Linear, 6> borders{Linear{-(m.lightWeight * m.normal), m.lightHeight},
                                        w,
                                        plus(x, margin, w),
                                        plus(minus(x), size.x + margin, w),
                                        plus(y, margin, w),
                                        plus(minus(y), size.y + margin, w)};
    std::ranges::transform(borders, borders_.begin(), [](const Linear& border) {
        const auto middle = [](const Interval& i) { return 0.5 * (i.inf() + i.sup()); };
        // Twice the width, for the middle is rounded, too, and what is multiplied by it is a difference of points.
        const auto error = [](const Interval& i) { return 2 * (i.sup() - i.inf()) + determinantError * std::abs(i.sup()); };
        const auto& [slope, offset] = border;
        return Border{{middle(slope.x), middle(slope.y), middle(slope.z)},
                      middle(offset),
                      std::max({error(slope.x), error(slope.y), error(slope.z)}),
                      error(offset)};
    });
}

bool ShadowProjection::misses(std::span<const glm::dvec3> points) const {
    return std::ranges::any_of(borders_, [&](const Border& border) {
        return std::ranges::all_of(points, [&](const glm::dvec3& point) {
            const glm::dvec3 from = point - receiver_[0];
            const double length = std::abs(from.x) + std::abs(from.y) + std::abs(from.z);
            return glm::dot(border.slope, from) + border.offset < -(border.slopeError * length + border.offsetError);
        });
    });
}

ShadowProjection::~ShadowProjection() = default;

int ShadowProjection::height(const glm::dvec3& vertex) const { return side(receiver_, glm::dvec4(vertex, 1)); }

ShadowVertex ShadowProjection::project(const glm::dvec3& vertex) const {
    const Interval::Protector rounding;
    return map_->project(vector<Interval>(vertex));
}

ShadowVertex ShadowProjection::contact(const glm::dvec3& a, const glm::dvec3& b) const {
    const Interval::Protector rounding;
    const Vector<Interval> from = vector<Interval>(a), to = vector<Interval>(b);
    const Interval ha = map_->heightOf(from), hb = map_->heightOf(to);
    const Interval drop = ha - hb;
    const Interval share = holdsZero(drop) ? Interval(0, 1) : ha / drop;
    return map_->project(from + share * (to - from));
}

} // namespace shadowbench::groundtruth::geometry
