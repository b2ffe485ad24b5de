// What the two readers of a glTF 2.0 file share: that of its scene (scene/exchange) and that of its meshes (scene/meshes).
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace shadowbench {

/// The two chunks of a .glb; `binary` is empty where it has none.
struct GlbChunks {
    std::string_view json, binary;
};

/// Throws BadInput, without a file's name, unless header, lengths and kinds of chunks are those of glTF 2.0.
GlbChunks glbChunks(std::string_view bytes);

/// Throws BadInput for an extension that a file requires, unless it leaves shapes and places as they are.
void requireHarmless(const std::string& extension);

/// Each name once: "_2", "_3", … follow where it is taken.
class UniqueNames {
public:
    std::string add(const std::string& name);

private:
    std::map<std::string, int> last_; // number that was added to a name
    std::set<std::string> taken_;
};

/// The names of a file's primitives, asked for in their order: that of the mesh, or "mesh 3" by its number, made unique.
class PartNames {
public:
    std::string next(const std::string& mesh, std::size_t number);

private:
    UniqueNames names_;
};

} // namespace shadowbench
