// What can be said of a scene's meshes without looking at the picture.
#pragma once

#include "harness/inspect/inspection.h"

namespace shadowbench::inspect {

std::vector<MeshReport> meshReports(const Scene& scene);

/// The largest area that lies in one plane across each axis, and where along the axis it lies.
struct FlatAreas {
    glm::dvec3 area{0}, place{0};
};
FlatAreas flatAreas(const Scene& scene);

/// The name of the object that each instance belongs to: of Placement::id at id − 1.
std::vector<std::string> namesOfInstances(const Scene& scene);

} // namespace shadowbench::inspect
