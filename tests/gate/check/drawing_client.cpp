// A renderer of exported scenes that is exact, and makes one mistake on demand: what `check` must name. It shares no code
// with the program: it reads scene.json and scene.bin, and traces a ray through the centre of each pixel.
//   drawing_client SCENE FRAMES OUT MISTAKE DEFINITION
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using nlohmann::json;

std::string mistake, definition;

bool makes(const char* name) { return mistake == name; }

dvec3 vec(const json& values) { return {values[0], values[1], values[2]}; }

dmat4 mat(const json& values) {
    dmat4 matrix;
    for (int i = 0; i < 16; ++i) {
        const bool transposed = makes("matrices-by-rows");
        matrix[transposed ? i % 4 : i / 4][transposed ? i / 4 : i % 4] = values[static_cast<std::size_t>(i)];
    }
    if (makes("matrices-by-rows")) {
        for (int c = 0; c < 3; ++c) matrix[c][3] = 0;
        matrix[3] = dvec4(values[12], values[13], values[14], 1);
    }
    if (makes("no-matrices")) return dmat4(1);
    if (makes("no-turn")) {
        dmat4 moved(1);
        moved[3] = matrix[3];
        return moved;
    }
    return matrix;
}

struct Triangle {
    dvec3 a, b, c;
    bool open;
    [[nodiscard]] dvec3 normal() const { return glm::normalize(glm::cross(b - a, c - a)); }
};

/// How far along the ray; infinity for none.
double hit(const Triangle& t, const dvec3& from, const dvec3& along) {
    const dvec3 u = t.b - t.a, v = t.c - t.a, p = glm::cross(along, v);
    const double determinant = glm::dot(u, p);
    constexpr double none = std::numeric_limits<double>::infinity();
    if (determinant == 0) return none;
    const dvec3 s = from - t.a, q = glm::cross(s, u);
    const double b = glm::dot(s, p) / determinant, c = glm::dot(along, q) / determinant;
    if (b < 0 || c < 0 || b + c > 1) return none;
    const double distance = glm::dot(v, q) / determinant;
    return distance > 1e-9 ? distance : none;
}

struct Mesh {
    std::vector<dvec3> positions;
    std::vector<unsigned> indices;
    bool closed = true;
};

Mesh meshIn(const json& gltf, const std::string& bytes, const std::string& name, bool closed) {
    const auto view = [&](int accessor) {
        const json& a = gltf["accessors"][accessor];
        const json& v = gltf["bufferViews"][static_cast<std::size_t>(a["bufferView"])];
        return std::pair(bytes.data() + v.value("byteOffset", 0) + a.value("byteOffset", 0), static_cast<int>(a["count"]));
    };
    Mesh mesh;
    mesh.closed = closed;
    for (const json& one : gltf["meshes"]) {
        if (one["name"] != name) continue;
        const json& primitive = one["primitives"][0];
        const auto [positions, count] = view(primitive["attributes"]["POSITION"]);
        for (int i = 0; i < count; ++i) {
            float xyz[3];
            std::memcpy(xyz, positions + 12 * i, 12);
            mesh.positions.emplace_back(xyz[0], xyz[1], xyz[2]);
        }
        const int accessor = primitive["indices"];
        const bool isShort = gltf["accessors"][accessor]["componentType"] == 5123;
        const auto [indices, all] = view(accessor);
        for (int i = 0; i < all; ++i) {
            std::uint32_t index = 0;
            std::memcpy(&index, indices + (isShort ? 2 : 4) * i, isShort ? 2 : 4);
            mesh.indices.push_back(index);
        }
    }
    return mesh;
}

struct World {
    std::vector<Triangle> triangles;
    json light, camera;

    [[nodiscard]] dvec3 lightPlace() const {
        const dvec3 at = vec(light.contains("centre") ? light["centre"] : light["direction"]);
        if (makes("light-z")) return {at.x, at.y, -at.z};
        if (makes("light-z-up")) return {at.x, at.z, at.y};
        if (makes("light-negated")) return -at;
        if (light.contains("centre") && makes("light-in-centimetres")) return 100.0 * at;
        if (light.contains("centre") && makes("light-at-eye")) return vec(camera["eye"]);
        return at;
    }

    [[nodiscard]] bool shadowed(const dvec3& from, const dvec3& along, double until) const {
        for (const Triangle& t : triangles) {
            const double at = hit(t, from, along);
            if (at < until) return true;
        }
        return false;
    }

    /// Of the light's point; `to` goes there.
    [[nodiscard]] double visible(const dvec3& at, const dvec3& normal, const dvec3& to, double until) const {
        if (glm::dot(normal, to) <= 0) return 0;
        if (makes("wrong-bias")) { // stripes: a depth a little nearer than the surface, on a grid
            const double stripe = std::sin(40 * at.x) + std::sin(37 * at.z);
            if (stripe > 0.3) return 0;
        }
        const double lifted = makes("large-bias") ? 0.2 : 1e-7;
        return makes("no-shadows") || !shadowed(at + lifted * normal, to, until) ? 1 : 0;
    }

    [[nodiscard]] double visibility(const dvec3& at, const dvec3& normal) const {
        if (!light.contains("centre")) return visible(at, normal, -lightPlace(), 1e30);
        if (!light.contains("u") || definition == "hard" || makes("centre-of-area")) {
            const dvec3 to = lightPlace() - at;
            return visible(at, normal, to, 1);
        }
        constexpr int n = 8;
        double sum = 0, all = 0;
        const dvec3 u = vec(light["u"]), v = vec(light["v"]), front = glm::normalize(glm::cross(u, v));
        for (int s = 0; s < n; ++s)
            for (int t = 0; t < n; ++t) {
                const dvec3 to = lightPlace() + ((s + 0.5) / n - 0.5) * u + ((t + 0.5) / n - 0.5) * v - at;
                const double d = glm::length(to);
                const double weight = makes("irradiance") ? std::max(glm::dot(normal, to), 0.0) *
                                                                std::abs(glm::dot(front, to)) / (d * d * d * d)
                                                          : 1;
                sum += weight * visible(at, normal, to, 1);
                all += weight;
            }
        return all > 0 ? sum / all : 0;
    }
};

World worldOf(const json& scene, const json& gltf, const std::string& bytes, const json& frame, const json& first) {
    World world{{}, (makes("old-light") ? first : frame)["light"], (makes("old-camera") ? first : frame)["camera"]};
    const json& nodes = (makes("old-meshes") ? first : frame)["nodes"];
    for (const json& node : nodes) {
        bool closed = true;
        for (const json& mesh : scene["meshes"])
            if (mesh["name"] == node["mesh"]) closed = mesh["closed"];
        const Mesh mesh = meshIn(gltf, bytes, node["mesh"], closed);
        const dmat4 place = mat(node["matrix"]);
        const auto corner = [&](unsigned index) {
            dvec3 at(place * dvec4(mesh.positions[index], 1));
            if (makes("meshes-z")) at.z = -at.z;
            return at;
        };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const Triangle t{corner(mesh.indices[i]), corner(mesh.indices[i + 1]), corner(mesh.indices[i + 2]), !closed};
            const bool faces = glm::dot(t.normal(), vec(frame["light"].value("centre", json{0, 1e6, 0})) - t.a) > 0;
            if (t.open && makes(faces ? "culls-front" : "culls-back")) continue;
            world.triangles.push_back(t);
        }
    }
    return world;
}

double tangent(const World& world, double aspect) {
    const double fovy = world.camera["fovy"], radians = fovy * std::acos(-1) / 180;
    if (makes("degrees-for-radians")) return std::abs(std::tan(fovy / 2));
    if (makes("half-angle")) return std::tan(radians);
    return std::tan(radians / 2) / (makes("horizontal-angle") ? aspect : 1);
}

/// The same in each frame, from 0 to 1: what a cheat that has the truth adds to it.
double randomAt(int x, int y) {
    std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U;
    for (const int shift : {15, 13, 16}) bits = (bits ^ bits >> shift) * 0x2C1B3C6DU;
    return (bits >> 8U) / 16777216.0;
}

bool isChosen(int x, int y) { return randomAt(x, y) < 0.02; }

void draw(const World& world, int width, int height, std::vector<float>& image) {
    const double aspect = static_cast<double>(width) / height, tan = tangent(world, aspect);
    const dvec3 eye = vec(world.camera["eye"]), forward = glm::normalize(vec(world.camera["target"]) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, vec(world.camera["up"]))), up = glm::cross(right, forward);
    const double centre = makes("corners") ? 0 : 0.5;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double px = (2 * (x + centre) / width - 1) * aspect * tan, py = (1 - 2 * (y + centre) / height) * tan;
            const dvec3 along = forward + px * right + py * up;
            double nearest = 1e30;
            const Triangle* seen = nullptr;
            for (const Triangle& t : world.triangles)
                if (const double at = hit(t, eye, along); at < nearest) {
                    nearest = at;
                    seen = &t;
                }
            double v = 0;
            if (seen != nullptr) {
                dvec3 normal = seen->normal();
                if (glm::dot(normal, along) > 0) normal = -normal;
                const dvec3 at = eye + nearest * along;
                v = world.visibility(at, normal);
                const dvec3 to = world.light.contains("centre") ? world.lightPlace() - at : -world.lightPlace();
                if (makes("shaded")) v *= 0.8 * std::max(0.0, glm::dot(normal, glm::normalize(to)));
                if (makes("ambient")) v = 0.2 + 0.8 * v;
                if (makes("second-light")) v = 0.5 + 0.5 * v;
                if (makes("inverted")) v = 1 - v;
                if (makes("flips") && isChosen(x, y)) v = 1 - v;
                if (makes("grey-noise")) v += (v > 0.5 ? -0.3 : 0.3) * randomAt(x, y);
                if (makes("srgb")) v = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
            }
            image[static_cast<std::size_t>(y * width + x)] = static_cast<float>(v);
        }
}

void write(const std::string& file, int width, int height, const std::vector<float>& image) {
    std::ofstream out(file, std::ios::binary);
    out << "Pf\n" << width << ' ' << height << "\n-1\n";
    for (int row = height - 1; row >= 0; --row) // a PFM begins with the lowest row
        for (int column = 0; column < width; ++column) {
            int y = row, x = column;
            if (makes("rows-bottom-up")) y = height - 1 - y;
            if (makes("mirrored")) x = width - 1 - x;
            if (makes("one-pixel-right")) x = std::max(0, x - 1);
            out.write(reinterpret_cast<const char*>(&image[static_cast<std::size_t>(y * width + x)]), 4);
        }
}

std::string contentOf(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

} // namespace

int main(int, char** argument) {
    const std::string folder = argument[1], out = argument[3];
    mistake = argument[4];
    definition = argument[5];
    const json scene = json::parse(contentOf(folder + "/scene.json")), gltf = json::parse(contentOf(folder + "/scene.gltf"));
    const std::string bytes = contentOf(folder + "/scene.bin");
    const int width = scene["size"][0], height = scene["size"][1];
    if (makes("writes-scene")) std::ofstream(folder + "/scene.json", std::ios::app) << '\n';
    if (makes("writes-own")) std::ofstream("kept", std::ios::app) << folder; // it runs in the folder of its list
    if (makes("writes-truth")) std::ofstream(std::string(argument[6]), std::ios::app) << "x";
    std::istringstream frames(argument[2]);
    for (std::string number; std::getline(frames, number, ',');)
        for (const json& frame : scene["frames"]) {
            const json& shown = makes("first-frame") ? scene["frames"][0] : frame;
            if (frame["index"] != std::stoi(number)) continue;
            std::vector<float> image(static_cast<std::size_t>(width * height));
            draw(worldOf(scene, gltf, bytes, shown, scene["frames"][0]), width, height, image);
            write(out + "/frame-" + number + ".pfm", width, height, image);
        }
}
