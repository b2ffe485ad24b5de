// A triangle under a point light in a file of another program's making: camera and light under turned parents. Tests change
// its JSON and load it, alone or through a scene file.
#pragma once

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "scene/load/load.h"

#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace shadowbench {

class ForeignGltf : public testing::Test {
protected:
    using Json = nlohmann::json;

    ForeignGltf() {
        const float positions[] = {-1, 0, -1, 0, 0, 1, 1, 0, -1};
        const std::uint32_t indices[] = {0, 1, 2};
        bin.resize(sizeof positions + sizeof indices);
        std::memcpy(bin.data(), positions, sizeof positions);
        std::memcpy(bin.data() + sizeof positions, indices, sizeof indices);
        writeFile(folder_.path() / "other.bin", bin);
    }

    [[nodiscard]] Scene loaded() const { return loaded("other.gltf", gltf.dump()); }
    [[nodiscard]] Scene loaded(const std::string& name, const std::string& content) const {
        writeFile(folder_.path() / name, content);
        return loadScene((folder_.path() / name).string(), Profile::Gate);
    }
    /// By a scene file of these lines.
    [[nodiscard]] Scene through(const std::string& lines) const {
        writeFile(folder_.path() / "other.gltf", gltf.dump());
        return loaded("level.toml", lines);
    }

    template <class Load>
    static std::string refusalOf(Load load) {
        try {
            static_cast<void>(load());
            return "loaded";
        } catch (const BadInput& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            return error.what();
        }
    }
    [[nodiscard]] std::string refusal() const {
        return refusalOf([&] { return loaded(); });
    }
    static void expectWithin(const std::string& said, const std::string& reason) {
        EXPECT_NE(said.find(reason), std::string::npos) << reason << " in: " << said;
    }
    void expectRefused(const std::string& reason) const {
        const std::string said = refusal();
        expectWithin(said, "other.gltf");
        expectWithin(said, reason);
    }

    TemporaryFolder folder_;
    std::string bin;
    Json gltf = Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
        "nodes": [{"mesh": 0, "translation": [0, 0.5, 0], "scale": [2, 2, 2]},
                  {"rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476], "translation": [0, 5, 0], "children": [2]},
                  {"camera": 0},
                  {"translation": [1, 4, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7853981633974483, "znear": 0.1, "zfar": 20,
                                                            "aspectRatio": 1.5}}],
        "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
        "buffers": [{"uri": "other.bin", "byteLength": 48}]})");
};

/// A .glb of these chunks.
inline std::string glbOf(std::string json, std::string bin) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    const auto words = [](std::initializer_list<std::size_t> numbers) {
        std::string bytes;
        for (const std::size_t number : numbers)
            for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 255U);
        return bytes;
    };
    const std::string chunks = words({json.size(), 0x4E4F534A}) + json + words({bin.size(), 0x004E4942}) + bin;
    return "glTF" + words({2, 12 + chunks.size()}) + chunks;
}

} // namespace shadowbench
