// What is wrong with a triangle mesh: how much of it, and where.
#pragma once

#include "scene/mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace shadowbench {

struct EdgeFaults {
    Fault open;    // edges of one triangle
    Fault crowded; // edges of more than two
    Fault turned;  // edges along which two triangles run in the same direction: one of them is turned inside out

    /// Every edge has two triangles, which run along it in opposite directions.
    [[nodiscard]] bool closed() const { return open.count + crowded.count + turned.count == 0; }
};

struct MeshFaults {
    EdgeFaults edges;
    Fault flat;            // triangles of no area, with those that the mesh is without
    Fault repeated;        // triangles with the corners of another one
    Fault doubled;         // positions that equal another one
    double volume = 0;     // signedVolume()
    std::size_t parts = 0; // connected by vertices
    Fault turnedParts;     // of a closed mesh: turned inside out and no cavity of another part; their first position
};

/// Throws BadInput naming `what` unless every position is finite and every index in range, as the others, weld() and
/// hasArea() ask for.
void requireNumbers(const Mesh& mesh, const std::string& what);

EdgeFaults edgeFaultsOf(const Mesh& mesh);
MeshFaults faultsOf(const Mesh& mesh);

/// The triangles that hang together by vertices, each part a mesh of its own.
std::vector<Mesh> partsOf(const Mesh& mesh);

/// MeshFaults::turnedParts of a closed mesh.
Fault turnedPartsOf(const std::vector<Mesh>& parts);

/// What a closed mesh encloses; below 0 where it is turned inside out.
double signedVolume(const Mesh& mesh);

/// How many times the surface winds round `point`: 1 within a closed mesh, −1 within one that is turned inside out, ½ on the
/// surface, 0 outside.
double windingNumber(const Mesh& mesh, const glm::dvec3& point);

} // namespace shadowbench
