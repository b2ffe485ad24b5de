#include "groundtruth/cgal/area/area_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shadowbench::groundtruth::area {
namespace {

constexpr int sides = 320;         // bracket: (π / sides)² = 9.6e-5 of the disk; a multiple of 4
constexpr double margin = 0x1p-50; // relative, above the rounding of a vertex

LightPolygon regular(double radius, double offset) {
    LightPolygon polygon;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i + offset) / sides;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return polygon;
}

} // namespace

double lightWindow(LightKind kind) { return kind == LightKind::Disk ? 0.5 + 0x1p-40 : 0.5; }

LightShape lightShape(LightKind kind) {
    if (kind == LightKind::Disk)
        return {regular(0.5 * (1 - margin), 0), regular(0.5 / std::cos(std::numbers::pi / sides) * (1 + margin), 0.5),
                std::numbers::pi / 4};
    const LightPolygon square{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    return {square, square, 1};
}

VisibleFraction enclosedFraction(const LightAreas& areas, const LightShape& shape) {
    if (shape.inner == shape.outer) {
        const double visible = std::clamp(areas.innerVisible / shape.area, 0.0, 1.0);
        return {visible, visible};
    }
    const double low = std::max(areas.innerVisible / shape.area, 1 - areas.outerHidden / shape.area);
    const double high = std::min(areas.outerVisible / shape.area, 1 - areas.innerHidden / shape.area);
    return {std::clamp(low, 0.0, 1.0), std::clamp(high, 0.0, 1.0)};
}

} // namespace shadowbench::groundtruth::area
