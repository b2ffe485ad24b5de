// The writer: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html and its extension KHR_lights_punctual.
#include "base/image_formats.h"
#include "scene/exchange/gltf.h"
#include "scene/exchange/json_values.h"
#include "scene/masked_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace shadowbench::exchange {
namespace {

constexpr int kFloat = 5126, kUnsignedInt = 5125;               // glTF's numbers for the types of components …
constexpr int kVertices = 34962, kIndices = 34963;              // … the uses of buffer views …
constexpr int kNearest = 9728, kLinear = 9729;                  // … filters, neither of which has mipmaps …
constexpr int kRepeat = 10497, kMirror = 33648, kClamp = 33071; // … and what is beyond a texture's border

/// One after the other in one buffer; a mesh that several parts show is there once.
class Buffer {
public:
    /// Accessors of the mesh's positions and indices.
    std::pair<std::size_t, std::size_t> accessorsOf(const Mesh& mesh) {
        const auto [known, isNew] = places_.try_emplace(&mesh);
        if (isNew) known->second = {addPositions(mesh), addIndices(mesh)};
        return known->second;
    }

    /// Accessor of places in a texture.
    std::size_t add(const std::vector<glm::vec2>& uv) {
        static_assert(sizeof(glm::vec2) == 8, "places are written as they lie in memory");
        return add(uv.data(), uv.size() * sizeof(glm::vec2), kVertices,
                   {{"componentType", kFloat}, {"count", uv.size()}, {"type", "VEC2"}});
    }

    Json views = Json::array(), accessors = Json::array();
    std::string bytes;

private:
    std::size_t add(const void* data, std::size_t size, int target, Json accessor) {
        views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}, {"target", target}});
        bytes.append(static_cast<const char*>(data), size);
        accessor["bufferView"] = views.size() - 1;
        accessors.push_back(std::move(accessor));
        return accessors.size() - 1;
    }

    std::size_t addPositions(const Mesh& mesh) {
        static_assert(sizeof(glm::vec3) == 12, "positions are written as they lie in memory");
        const Bounds box = mesh.bounds();
        return add(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3), kVertices,
                   {{"componentType", kFloat},
                    {"count", mesh.positions.size()},
                    {"type", "VEC3"},
                    {"min", listOf(box.low)},
                    {"max", listOf(box.high)}});
    }

    std::size_t addIndices(const Mesh& mesh) {
        static_assert(sizeof(glm::uvec3) == 12, "indices are written as they lie in memory");
        return add(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3), kIndices,
                   {{"componentType", kUnsignedInt}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}});
    }

    std::map<const Mesh*, std::pair<std::size_t, std::size_t>> places_;
};

/// What only shadowbench reads.
Json ours(Json members) { return {{"shadowbench", std::move(members)}}; }

Json materialOf(const Part& part) {
    return {{"name", part.name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {part.colour.x, part.colour.y, part.colour.z, 1}},
              {"metallicFactor", 0},
              {"roughnessFactor", 1}}},
            {"doubleSided", !part.mesh->closed}};
}

Json meshOf(const Part& part, const MaskedMesh* cards, std::size_t material, Buffer& buffer) {
    const auto [positions, indices] = buffer.accessorsOf(cards != nullptr ? cards->mesh : *part.mesh);
    Json attributes{{"POSITION", positions}};
    if (cards != nullptr) attributes["TEXCOORD_0"] = buffer.add(cards->uv);
    return {{"name", part.name},
            {"primitives", Json::array({{{"attributes", attributes}, {"indices", indices}, {"material", material}}})}};
}

/// White, with the mask as its alpha.
std::string pngOf(const Image<float>& alpha) {
    std::vector<std::uint8_t> pixels;
    for (const float a : alpha)
        pixels.insert(pixels.end(),
                      {255, 255, 255, static_cast<std::uint8_t>(std::lround(255 * std::clamp(a, 0.0F, 1.0F)))});
    return png::encoded(alpha.width(), alpha.height(), 4, pixels);
}

int numberOf(AlphaMask::Wrap wrap) {
    if (wrap == AlphaMask::Wrap::Clamp) return kClamp;
    return wrap == AlphaMask::Wrap::Mirror ? kMirror : kRepeat;
}

/// The mask as a texture of the file, with an image and a sampler of its own.
void addTexture(const AlphaMask& mask, const std::string& image, Json& gltf) {
    const int filter = mask.nearest ? kNearest : kLinear;
    gltf["samplers"].push_back(
        {{"magFilter", filter}, {"minFilter", filter}, {"wrapS", numberOf(mask.u)}, {"wrapT", numberOf(mask.v)}});
    gltf["images"].push_back({{"uri", image}});
    const std::size_t number = gltf["textures"].size();
    gltf["textures"].push_back({{"sampler", number}, {"source", number}});
}

/// An identity is left out: glTF calls for it.
void place(Json& node, const glm::dmat4& world) {
    if (world != glm::dmat4(1)) node["matrix"] = listOf(world);
}

/// A turn that takes −z to `forward`, and a place.
glm::dmat4 lookingAlong(const glm::dvec3& forward, const glm::dvec3& from) {
    const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::inverse(glm::lookAt(from, from + forward, up));
}

Json cameraNode(const Camera& camera) {
    const auto [right, up, forward] = camera.basis();
    Json node{{"name", "camera"}, {"camera", 0}};
    place(node, {glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(-forward, 0), glm::dvec4(camera.eye, 1)});
    return node;
}

Json cameraOf(const Camera& camera, const glm::ivec2& size) {
    return {{"name", "camera"},
            {"type", "perspective"},
            {"perspective",
             {{"aspectRatio", static_cast<double>(size.x) / size.y},
              {"yfov", glm::radians(camera.fovy)},
              {"zfar", camera.far},
              {"znear", camera.near}}},
            {"extras", ours(jsonOf(camera, size))}};
}

bool isDistant(const Light& light) { return light.kind == LightKind::Directional || light.isEnvironment(); }

Json lightNode(const Snapshot& frame) {
    const Light& light = frame.light;
    const Bounds all = frame.bounds();
    Json node{{"name", "light"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    if (isDistant(light)) // it has no place; viewers show it outside of what it lights
        place(node, lookingAlong(light.direction, all.centre() - glm::distance(all.low, all.high) * light.direction));
    else
        place(node, glm::translate(glm::dmat4(1), light.centre));
    return node;
}

/// As bright as makes a white surface that faces the light at the camera's target white: π lux.
double intensityOf(const Snapshot& frame) {
    if (isDistant(frame.light)) return glm::pi<double>();
    const double distance = glm::distance(frame.light.centre, frame.camera.target);
    return distance > 0 ? glm::pi<double>() * distance * distance : glm::pi<double>();
}

Json lightsOf(const Snapshot& frame) {
    return Json::array({{{"name", "light"},
                         {"type", isDistant(frame.light) ? "directional" : "point"},
                         {"intensity", intensityOf(frame)},
                         {"extras", ours(jsonOf(frame.light))}}});
}

Json assetOf(const Scene& scene, const Snapshot& frame) {
    return {{"version", "2.0"},
            {"generator", "shadowbench"},
            {"extras", ours({{"scene", scene.id},
                             {"profile", name(scene.profile)},
                             {"frame", frame.frame},
                             {"size", {scene.size.x, scene.size.y}}})}};
}

Json instanceNodes(const Snapshot& frame, const Parts& parts) {
    Json nodes = Json::array();
    for (const Node& node : nodesOf(frame, parts)) {
        nodes.push_back({{"name", parts.instanceName(node.placement->id)},
                         {"mesh", node.part},
                         {"extras", ours({{"id", node.placement->id}})}});
        place(nodes.back(), node.placement->world);
    }
    return nodes;
}

} // namespace

GltfFiles gltfOf(const Scene& scene, const Snapshot& frame, const Parts& parts, const std::string& name, Holes holes) {
    GltfFiles files;
    Json gltf{{"asset", assetOf(scene, frame)}};
    gltf["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = lightsOf(frame);
    gltf["cameras"] = Json::array({cameraOf(frame.camera, scene.size)});

    Buffer buffer;
    std::map<const AlphaMask*, std::size_t> textures;
    for (const Part& part : parts.list()) {
        const MaskedMesh* cards = holes == Holes::Masked ? part.mesh->cards.get() : nullptr;
        Json material = materialOf(part);
        if (cards != nullptr) {
            const auto [texture, isNew] = textures.try_emplace(cards->mask.get(), textures.size());
            if (isNew) {
                files.emplace_back(fmt::format("{}-{}.png", name, part.name), pngOf(cards->mask->alpha));
                addTexture(*cards->mask, files.back().first, gltf);
            }
            material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture->second}};
            material["alphaMode"] = "MASK";
            material["alphaCutoff"] = cards->mask->cutoff;
        }
        gltf["materials"].push_back(std::move(material));
        gltf["meshes"].push_back(meshOf(part, cards, gltf["materials"].size() - 1, buffer));
    }
    Json nodes = instanceNodes(frame, parts);
    nodes.push_back(cameraNode(frame.camera));
    nodes.push_back(lightNode(frame));
    Json roots = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
    gltf["nodes"] = std::move(nodes);
    gltf["scenes"] = Json::array({{{"name", scene.id}, {"nodes", std::move(roots)}}});
    gltf["scene"] = 0;
    gltf["accessors"] = std::move(buffer.accessors);
    gltf["bufferViews"] = std::move(buffer.views);
    gltf["buffers"] = Json::array({{{"uri", name + ".bin"}, {"byteLength", buffer.bytes.size()}}});
    files.emplace_back(name + ".bin", std::move(buffer.bytes));
    files.emplace_back(name + ".gltf", textOf(gltf, 2));
    return files;
}

} // namespace shadowbench::exchange
