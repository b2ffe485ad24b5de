// What renderers in C++ share: the folder that `shadowbench export` writes (docs/exchange.md), their command line, the
// images that they write, and how they end.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

/// An error with a sentence for the user.
struct BadInput : std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Point = std::array<float, 3>;

struct ExportedMesh {
    std::vector<Point> vertices; // three of each triangle
    bool closed = true;
};

struct ExportedScene {
    nlohmann::json frames;                      // as in scene.json
    std::map<std::string, ExportedMesh> meshes; // by name
    int width = 0;
    int height = 0;
};

inline nlohmann::json readJson(const std::filesystem::path& file) {
    try {
        std::ifstream stream(file);
        return nlohmann::json::parse(stream);
    } catch (const nlohmann::json::exception& error) {
        throw BadInput("cannot read " + file.string() + ": " + error.what() + "; `shadowbench export` writes it");
    }
}

/// The indices of the triangles' vertices, whichever of the three integer types of glTF they have.
inline std::vector<unsigned> readIndices(const nlohmann::json& accessor, const char* from) {
    std::vector<unsigned> indices(accessor.at("count").get<std::size_t>());
    const int type = accessor.at("componentType");
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (type == 5121)
            indices[i] = reinterpret_cast<const std::uint8_t*>(from)[i];
        else if (type == 5123)
            indices[i] = reinterpret_cast<const std::uint16_t*>(from)[i];
        else
            indices[i] = reinterpret_cast<const std::uint32_t*>(from)[i];
    }
    return indices;
}

inline ExportedScene readExportedScene(const std::filesystem::path& folder) {
    const nlohmann::json scene = readJson(folder / "scene.json");
    if (scene.value("format", "") != "shadowbench-scene" || scene.value("version", 0) != 1)
        throw BadInput((folder / "scene.json").string() + " is not a shadowbench-scene of version 1");
    const nlohmann::json gltf = readJson(folder / scene.value("gltf", "scene.gltf"));
    std::ifstream stream(folder / gltf.at("buffers").at(0).at("uri").get<std::string>(), std::ios::binary);
    if (!stream) throw BadInput("cannot read the meshes of " + folder.string() + "; export the scene again");
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const auto start = [&](const nlohmann::json& accessor) {
        const nlohmann::json& view = gltf.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        return bytes.data() + view.value("byteOffset", 0U) + accessor.value("byteOffset", 0U);
    };
    ExportedScene exported{scene.at("frames"), {}, scene.at("size").at(0), scene.at("size").at(1)};
    for (const nlohmann::json& mesh : gltf.at("meshes")) {
        const nlohmann::json& primitive = mesh.at("primitives").at(0);
        const auto accessor = [&](const nlohmann::json& number) {
            return gltf.at("accessors").at(number.get<std::size_t>());
        };
        const auto* positions = reinterpret_cast<const Point*>(start(accessor(primitive.at("attributes").at("POSITION"))));
        const nlohmann::json indices = accessor(primitive.at("indices"));
        ExportedMesh& made = exported.meshes[mesh.at("name")];
        for (const unsigned index : readIndices(indices, start(indices))) made.vertices.push_back(positions[index]);
    }
    for (const nlohmann::json& mesh : scene.at("meshes")) exported.meshes.at(mesh.at("name")).closed = mesh.at("closed");
    return exported;
}

/// The frames of a list with commas; all of them for an empty one.
inline std::vector<nlohmann::json> framesNamed(const ExportedScene& exported, const std::string& list) {
    std::vector<nlohmann::json> chosen;
    for (const nlohmann::json& frame : exported.frames)
        if (list.empty() ||
            ("," + list + ",").find("," + std::to_string(frame.at("index").get<int>()) + ",") != std::string::npos)
            chosen.push_back(frame);
    if (chosen.empty() ||
        (!list.empty() && chosen.size() != 1U + static_cast<std::size_t>(std::count(list.begin(), list.end(), ','))))
        throw BadInput("--frames " + list + ": the scene does not have all of these frames");
    return chosen;
}

/// Grey, 32-bit floats, rows from the bottom; whole or not at all.
inline void writePfm(const std::filesystem::path& file, int width, int height, const std::vector<float>& pixels) {
    const std::filesystem::path part = file.string() + ".part";
    std::ofstream stream(part, std::ios::binary);
    stream << "Pf\n" << width << ' ' << height << "\n-1.0\n";
    stream.write(reinterpret_cast<const char*>(pixels.data()), static_cast<std::streamsize>(pixels.size() * sizeof(float)));
    stream.close();
    if (!stream) throw BadInput("cannot write " + file.string());
    std::filesystem::rename(part, file);
}

/// The values by the options' names.
using Options = std::map<std::string, std::string>;

/// `--name value` or `--name=value`; `settings` are the names of the client's own: " --technique --map-size ".
inline Options readCommandLine(int count, char** words, const std::string& settings) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const std::string known = " --scene --out --frames" + settings;
        if (known.find(" " + name + " ") == std::string::npos) throw BadInput(word + "? --help names the options");
        if (equals == std::string::npos && ++i == count) throw BadInput(name + " is without its value");
        options[name] = equals == std::string::npos ? words[i] : word.substr(equals + 1);
    }
    for (const char* needed : {"--scene", "--out"})
        if (!options.contains(needed)) throw BadInput(std::string(needed) + " is missing; --help shows an example");
    return options;
}

/// The beginning of --help.
inline void printUsage(const std::string& client) {
    std::cout << "usage: clients/" << client << "/render --scene DIR --out DIR [--frames 59,60] [settings]\n\n"
              << "Writes the share of the light that arrives at each pixel, 1 = lit, as frame-<number>.pfm.\n\n"
                 "  --scene DIR   folder that `shadowbench export` wrote\n"
                 "  --frames LIST numbers of frames, with commas; all of the scene if not given\n"
                 "  --out DIR     folder for the images\n\n";
}

/// Renders as the command line says; the exit code of the program.
template <class PrintHelp, class Render>
int runClient(const std::string& client, int count, char** words, const std::string& settings, PrintHelp printHelp,
              Render render) {
    try {
        if (count > 1 && (std::string(words[1]) == "--help" || std::string(words[1]) == "-h")) return printHelp(), 0;
        render(readCommandLine(count, words, settings));
        return 0;
    } catch (const BadInput& error) {
        std::cerr << client << ": " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << client << ": " << error.what() << '\n';
        return 1;
    }
}
