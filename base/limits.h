// How much other people's files may ask for: numbers that stop a damaged or hostile file before it takes the machine's
// memory or time. Each has a variable of the environment that changes it (docs/limits.md).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace shadowbench {

enum class Limit {
    FileMib,       // of one file: a mesh, a buffer of a .gltf, an image
    TextMib,       // of one file of text: a scene, records, a manifest
    Triangles,     // of one mesh file
    Vertices,      // of one mesh file, before equal ones are joined
    Pixels,        // of one image
    Instances,     // of one object of a scene
    Nesting,       // of lists and objects in a file of JSON, of nodes in a .gltf
    MemoryMib,     // that a scene may need; the machine's own memory where that is less
    ReaderMib,     // memory of the child that reads a file
    ReaderSeconds, // processor time of that child, and one second more for each MiB that it reads
    CellSeconds,   // in which a technique folder's cell is drawn and scored
};

struct LimitEntry {
    Limit limit;
    std::string_view variable; // of the environment
    std::uint64_t usual, most; // without the variable, and the most that it may be set to
    std::string_view bounds;   // what it is of, in words
};

/// All limits, in the order of Limit.
std::span<const LimitEntry> limits();

std::string_view variableOf(Limit limit);

/// The number that holds. Throws BadInput naming the variable when it is set to something else than a whole number from 1 to
/// its most.
std::uint64_t limitOf(Limit limit);

/// "more than the 4000000 of SHADOWBENCH_MAX_TRIANGLES, which can be raised": the end of an error message.
std::string beyond(Limit limit);

} // namespace shadowbench
