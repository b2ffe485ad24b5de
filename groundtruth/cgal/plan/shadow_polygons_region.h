// Regions of a plane with exact borders. Internal: only files of this folder include it, for it names CGAL's number type.
#pragma once

#include "groundtruth/cgal/plan/shadow_polygons.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace shadowbench::groundtruth::plan {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactNumber = ExactKernel::FT;
using ExactPoint = ExactKernel::Point_2;
using ExactRing = std::vector<ExactPoint>;

struct ExactPolygon {
    ExactRing outer;              // counter-clockwise
    std::vector<ExactRing> holes; // clockwise
};

struct ExactRegion {
    std::vector<ExactPolygon> polygons;
};

/// How often two things cover a point: a shadow and its receiver, or the two sides of a comparison.
struct Covers {
    int first = 0, second = 0;
};

/// A directed segment: to its left there is `more` than to its right.
struct CoverEdge {
    ExactPoint from, to;
    Covers more;
    bool fence = false; // covers are not counted across it
};

/// Adds the region's border.
void addBorder(const ExactRegion& region, Covers inside, std::vector<CoverEdge>& edges);

enum class Location { Inside, Outside, OnBorder };

/// The faces into which segments cut the plane, and what covers them.
class CoveredPlane {
public:
    explicit CoveredPlane(const std::vector<CoverEdge>& edges);
    ~CoveredPlane();
    CoveredPlane(const CoveredPlane&) = delete;
    CoveredPlane& operator=(const CoveredPlane&) = delete;

    /// Counts from the unbounded face, which nothing covers. Throws InternalError if the edges do not close.
    void countFromOutside();

    /// Counts from the face that holds `point` up to the fences; beyond, nothing is covered. False, and nothing counted, if
    /// the point lies on an edge.
    bool countFrom(const ExactPoint& point, Covers covers);

    /// Covers of points; nothing where they lie on an edge.
    [[nodiscard]] std::vector<std::optional<Covers>> at(const std::vector<ExactPoint>& points) const;

    /// The border of what a point sees, which edges hide, counter-clockwise; nothing if the point lies on an edge. It must
    /// stand in a bounded face.
    [[nodiscard]] std::optional<ExactRing> visibleFrom(const ExactPoint& point) const;

    /// The closure of the faces whose covers satisfy `inside`.
    [[nodiscard]] ExactRegion where(const std::function<bool(Covers)>& inside) const;

private:
    struct Faces;
    std::unique_ptr<Faces> faces_;
};

/// One per point.
std::vector<Location> locate(const ExactRegion& region, const std::vector<ExactPoint>& points);

/// To some 1e-16 of the area around the polygons; positive if there is any.
double areaOf(const ExactRegion& region);

} // namespace shadowbench::groundtruth::plan
