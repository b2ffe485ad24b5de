// An exported scene in a folder of its own, and its files as another program reads them: by the description in
// docs/exchange.md alone, without any of the project's readers.
#pragma once

#include "base/files.h"
#include "base/temporary_folder.h"
#include "scene/exchange/export.h"
#include "scene/load/load.h"

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace shadowbench {

class ExportedFolder {
public:
    explicit ExportedFolder(const Scene& scene) : written(exchange::exportScene(scene, path())) {}

    [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "exported"; }
    [[nodiscard]] std::string text(const std::string& file) const { return readFile(path() / file); }
    [[nodiscard]] nlohmann::json json(const std::string& file) const { return nlohmann::json::parse(text(file)); }

private:
    TemporaryFolder folder_;

public:
    exchange::Exported written;
};

inline glm::dvec3 vectorOf(const nlohmann::json& list) { return {list.at(0), list.at(1), list.at(2)}; }

inline glm::dmat4 matrixOf(const nlohmann::json& list) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = list.at(static_cast<std::size_t>(i));
    return matrix;
}

/// The groups of an OBJ by name; closed is not said.
inline std::map<std::string, Mesh> groupsOf(const std::string& obj) {
    std::map<std::string, Mesh> groups;
    Mesh* group = nullptr;
    std::uint32_t before = 1, seen = 1; // OBJ counts from 1, through the file
    std::istringstream lines(obj);
    for (std::string word, line; std::getline(lines, line);) {
        std::istringstream words(line);
        words >> word;
        if (word == "o") {
            words >> word;
            group = &groups[word];
            before = seen;
        } else if (word == "v") {
            glm::vec3 p;
            words >> p.x >> p.y >> p.z;
            group->positions.push_back(p);
            ++seen;
        } else if (word == "f") {
            glm::uvec3 t;
            words >> t.x >> t.y >> t.z;
            group->triangles.push_back(t - before);
        }
    }
    return groups;
}

/// The mesh that a glTF node shows, from the bytes of the buffer.
inline Mesh meshOf(const nlohmann::json& gltf, const nlohmann::json& node, const std::string& bin) {
    const auto& primitive = gltf["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    const auto read = [&](std::size_t accessor, auto& values) {
        const auto& a = gltf["accessors"][accessor];
        const auto& view = gltf["bufferViews"][a["bufferView"].get<std::size_t>()];
        values.resize(view["byteLength"].get<std::size_t>() / 12);
        std::memcpy(values.data(), bin.data() + view["byteOffset"].get<std::size_t>(), 12 * values.size());
    };
    Mesh mesh;
    read(primitive["attributes"]["POSITION"], mesh.positions);
    read(primitive["indices"], mesh.triangles);
    mesh.closed = !gltf["materials"][primitive["material"].get<std::size_t>()]["doubleSided"].get<bool>();
    return mesh;
}

} // namespace shadowbench
