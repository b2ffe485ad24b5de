// The shapes of area lights in light coordinates.
#pragma once

#include "groundtruth/cgal/area/area.h"

#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::groundtruth::area {

/// Half the side of the square in light coordinates around a light's shape. A circumscribed polygon reaches beyond the disk.
double lightWindow(LightKind kind);

/// A convex polygon of double coordinates, counter-clockwise.
using LightPolygon = std::vector<glm::dvec2>;

/// Two convex polygons that enclose a light's shape from within and without; equal for a rectangle.
struct LightShape {
    LightPolygon inner, outer;
    double area; // of the shape itself
};

/// Of a rectangle, or of a disk: regular polygons of 320 sides, the inner one certainly within the disk and the outer one
/// certainly around it.
LightShape lightShape(LightKind kind);

/// The parts of the two polygons that are visible and hidden.
struct LightAreas {
    double innerVisible, innerHidden, outerVisible, outerHidden;
};

/// The share of the shape that is visible: at least what is seen of the inner polygon, and at most what is seen of the outer
/// one; and the same of what is hidden.
VisibleFraction enclosedFraction(const LightAreas& areas, const LightShape& shape);

} // namespace shadowbench::groundtruth::area
