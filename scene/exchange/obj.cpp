#include "scene/exchange/texts.h"

#include <fmt/format.h>
#include <iterator>

namespace shadowbench::exchange {

std::string objOf(const Parts& parts) {
    std::string text = "# Each mesh in its own space; scene.json says where its instances stand in each frame.\n"
                       "mtllib scene.mtl\n";
    const auto out = std::back_inserter(text);
    std::size_t first = 1; // OBJ counts vertices from 1, through the whole file
    for (const Part& part : parts.list()) {
        fmt::format_to(out, "o {0}\nusemtl {0}\n", part.name);
        for (const glm::vec3& p : part.mesh->positions) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
        for (const glm::uvec3& t : part.mesh->triangles)
            fmt::format_to(out, "f {} {} {}\n", first + t.x, first + t.y, first + t.z);
        first += part.mesh->positions.size();
    }
    return text;
}

std::string mtlOf(const Parts& parts) {
    std::string text;
    for (const Part& part : parts.list())
        text += fmt::format("newmtl {}\nKd {} {} {}\nillum 1\n", part.name, part.colour.x, part.colour.y, part.colour.z);
    return text;
}

} // namespace shadowbench::exchange
