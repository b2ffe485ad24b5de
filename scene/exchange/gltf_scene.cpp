// A glTF file as a scene: its meshes where its nodes put them, its camera and its light, at rest.
#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "scene/exchange/gltf.h"
#include "scene/exchange/json_values.h"

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <sstream>
#include <toml++/toml.h>
#include <vector>

namespace shadowbench::exchange {
namespace {

namespace fs = std::filesystem;

const Json none = Json::object();
const Json noList = Json::array();

/// A member, or an empty object.
const Json& member(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found == json.end() ? none : *found;
}
const Json& listIn(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found == json.end() ? noList : *found;
}
/// What the exporter has added to an element of its files.
const Json& ours(const Json& element) { return member(member(element, "extras"), "shadowbench"); }

toml::array listOf(const glm::dvec3& v) { return toml::array{v.x, v.y, v.z}; }

toml::array listOf(const glm::dmat4& matrix) {
    toml::array list;
    for (int i = 0; i < 16; ++i) list.push_back(matrix[i / 4][i % 4]);
    return list;
}

/// The same in TOML; a null is left out.
void insert(toml::table& table, const std::string& key, const Json& value);

void append(toml::array& list, const Json& value) {
    toml::table holder;
    insert(holder, "it", value);
    if (const toml::node* made = holder.get("it")) list.push_back(*made);
}

void insert(toml::table& table, const std::string& key, const Json& value) {
    if (value.is_string()) table.insert(key, value.get<std::string>());
    if (value.is_boolean()) table.insert(key, value.get<bool>());
    if (value.is_number_integer()) table.insert(key, value.get<std::int64_t>());
    if (value.is_number_float()) table.insert(key, value.get<double>());
    if (value.is_array()) {
        toml::array list;
        for (const Json& one : value) append(list, one);
        table.insert(key, std::move(list));
    }
    if (value.is_object()) {
        toml::table inner;
        for (const auto& [name, one] : value.items()) insert(inner, name, one);
        table.insert(key, std::move(inner));
    }
}

toml::table tableOf(const Json& members) {
    toml::table table;
    for (const auto& [name, value] : members.items()) insert(table, name, value);
    return table;
}

glm::dvec3 vectorOr(const Json& node, const char* name, const glm::dvec3& otherwise) {
    const Json& list = listIn(node, name);
    return list.empty() ? otherwise : glm::dvec3(list.at(0), list.at(1), list.at(2));
}

glm::dmat4 localOf(const Json& node) {
    glm::dmat4 matrix(1);
    if (const Json& numbers = listIn(node, "matrix"); !numbers.empty()) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers.at(static_cast<std::size_t>(i));
        return matrix;
    }
    const Json& turn = listIn(node, "rotation"); // x, y, z, w
    const glm::dquat rotation =
        turn.empty() ? glm::dquat(1, 0, 0, 0) : glm::dquat(turn.at(3), turn.at(0), turn.at(1), turn.at(2));
    const glm::dvec3 scale = vectorOr(node, "scale", glm::dvec3(1));
    matrix = glm::mat4_cast(rotation);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
    matrix[3] = glm::dvec4(vectorOr(node, "translation", glm::dvec3(0)), 1);
    return matrix;
}

/// Where a camera or a light looks: along its node's −z.
glm::dvec3 forwardOf(const glm::dmat4& world) { return glm::normalize(-glm::dvec3(world[2])); }

class GltfScene {
public:
    explicit GltfScene(const fs::path& file) : file_(file), gltf_(parse(readFile(file))) {
        if (member(gltf_, "asset").value("version", std::string()) != "2.0") fail("it is no glTF 2.0");
    }

    [[noreturn]] void fail(const std::string& sentence) const {
        throw BadInput(fmt::format("cannot load {} as a scene: {}", file_.string(), sentence));
    }

    [[nodiscard]] const Json& gltf() const { return gltf_; }

    std::string text() {
        const Json& scenes = listIn(gltf_, "scenes");
        const std::size_t shown = gltf_.contains("scene") ? whole(gltf_["scene"]) : 0;
        if (shown >= scenes.size()) fail(fmt::format("it has no scenes[{}]", shown));
        for (const Json& root : listIn(scenes[shown], "nodes")) visit(root, glm::dmat4(1), 0);
        if (objects_.empty()) fail("no node of it shows a mesh");
        const Json& asset = ours(gltf_["asset"]);
        toml::table root{{"title", asset.value("scene", file_.stem().string())},
                         {"camera", onlyOne(cameras_, "camera")},
                         {"light", onlyOne(lights_, "light of KHR_lights_punctual")},
                         {"timeline", toml::table{{"moving", 0}}}};
        for (const char* name : {"profile", "size"})
            if (asset.contains(name)) insert(root, name, asset[name]);
        if (!asset.contains("size")) root.insert("size", sizeOf());
        toml::array objects;
        for (toml::table& object : objects_) objects.push_back(std::move(object));
        root.insert("object", std::move(objects));
        std::ostringstream text;
        text << root << "\n";
        return text.str();
    }

private:
    [[nodiscard]] Json parse(const std::string& text) const {
        Json json = Json::parse(text, nullptr, false);
        if (!json.is_object()) fail("it is not valid JSON");
        return json;
    }

    [[nodiscard]] std::size_t whole(const Json& number) const {
        try {
            return wholeNumber<std::size_t>(number);
        } catch (const BadInput& error) {
            fail(error.what());
        }
    }

    [[nodiscard]] const Json& entry(const Json& list, const char* name, const Json& index) const {
        const std::size_t at = whole(index);
        if (at >= list.size()) fail(fmt::format("it has no {}[{}]", name, at));
        return list[at];
    }

    toml::table onlyOne(std::vector<toml::table>& found, const char* what) const {
        if (found.size() != 1) fail(fmt::format("its nodes hold {} of kind {}; a scene has one", found.size(), what));
        return std::move(found.front());
    }

    void visit(const Json& index, const glm::dmat4& parent, std::size_t depth) {
        const Json& nodes = listIn(gltf_, "nodes");
        const Json& node = entry(nodes, "nodes", index);
        if (depth >= nodes.size() || ++visits_ > nodes.size()) fail("its nodes are no tree");
        const glm::dmat4 world = parent * localOf(node);
        if (node.contains("mesh")) addMesh(node["mesh"], world);
        if (node.contains("camera")) addCamera(entry(listIn(gltf_, "cameras"), "cameras", node["camera"]), world);
        const Json& light = member(member(node, "extensions"), "KHR_lights_punctual");
        if (light.contains("light")) {
            const Json& lights = listIn(member(member(gltf_, "extensions"), "KHR_lights_punctual"), "lights");
            addLight(entry(lights, "lights", light["light"]), world);
        }
        for (const Json& child : listIn(node, "children")) visit(child, world, depth + 1);
    }

    void addMesh(const Json& index, const glm::dmat4& world) {
        const Json& mesh = entry(listIn(gltf_, "meshes"), "meshes", index);
        const std::size_t number = whole(index);
        // Instances keep the order of their nodes, and so their numbers.
        if (objects_.empty() || lastMesh_ != number) objects_.push_back(objectOf(mesh, number));
        lastMesh_ = number;
        objects_.back()["place"].as_array()->push_back(toml::table{{"matrix", listOf(world)}});
    }

    toml::table objectOf(const Json& mesh, std::size_t number) const {
        const std::string name = mesh.value("name", std::string());
        if (name.empty()) fail(fmt::format("meshes[{}] has no name", number));
        if (listIn(mesh, "primitives").size() != 1)
            fail(fmt::format("mesh \"{}\" has {} primitives; write each as a mesh of its own", name,
                             listIn(mesh, "primitives").size()));
        const Json& primitive = mesh["primitives"][0];
        const Json& material =
            primitive.contains("material") ? entry(listIn(gltf_, "materials"), "materials", primitive["material"]) : none;
        // Only our exporter promises that what is seen from outside alone is closed.
        const bool closed = !ours(gltf_["asset"]).empty() && !material.value("doubleSided", false);
        const glm::dvec3 colour = vectorOr(member(material, "pbrMetallicRoughness"), "baseColorFactor", glm::dvec3(0.8));
        return toml::table{{"name", name},
                           {"colour", listOf(colour)},
                           {"mesh", toml::table{{"file", file_.filename().string()}, {"part", name}, {"closed", closed}}},
                           {"place", toml::array()}};
    }

    void addCamera(const Json& camera, const glm::dmat4& world) {
        const Json& seen = member(camera, "perspective");
        if (const Json& exact = ours(camera); !exact.empty()) {
            cameras_.push_back(tableOf(exact));
            cameras_.back().erase("aspect");
        } else {
            if (seen.empty()) fail("its camera has no perspective");
            if (!seen.contains("zfar")) fail("its camera has no zfar: say how far the scene reaches");
            const glm::dvec3 eye(world[3]);
            cameras_.push_back(toml::table{{"eye", listOf(eye)},
                                           {"target", listOf(eye + forwardOf(world))},
                                           {"up", listOf(glm::normalize(glm::dvec3(world[1])))},
                                           {"fovy", glm::degrees(seen.at("yfov").get<double>())},
                                           {"near", seen.at("znear").get<double>()},
                                           {"far", seen.at("zfar").get<double>()}});
        }
        aspect_ = seen.value("aspectRatio", 1.0);
    }

    void addLight(const Json& light, const glm::dmat4& world) {
        if (const Json& exact = ours(light); !exact.empty()) {
            lights_.push_back(tableOf(exact));
            if (exact.contains("sky")) lights_.back().erase("direction"); // that of all its light, which follows
            return;
        }
        const auto type = light.at("type").get<std::string>();
        if (type == "point")
            lights_.push_back(toml::table{{"kind", type}, {"centre", listOf(glm::dvec3(world[3]))}});
        else if (type == "directional")
            lights_.push_back(toml::table{{"kind", type}, {"direction", listOf(forwardOf(world))}});
        else
            fail(fmt::format("its light is of type {}; a scene is lit by a point or directional light", type));
    }

    /// As high as the images of the gate profile are, where the camera alone says how wide they are.
    [[nodiscard]] toml::array sizeOf() const {
        constexpr double height = 256, most = 8192;
        const double width = std::round(height * aspect_);
        if (!(width >= 1 && width <= most)) fail(fmt::format("its camera has an aspectRatio of {:g}", aspect_));
        return toml::array{static_cast<int>(width), static_cast<int>(height)};
    }

    fs::path file_;
    Json gltf_;
    std::vector<toml::table> objects_, cameras_, lights_;
    std::size_t lastMesh_ = 0; // that objects_.back() shows
    double aspect_ = 1;
    std::size_t visits_ = 0;
};

template <class Work>
auto withSentence(const GltfScene& scene, Work work) {
    try {
        return work();
    } catch (const Json::exception& error) {
        scene.fail(fmt::format("a value is missing or of another kind than glTF asks for ({})", error.what()));
    }
}

} // namespace

SceneOfGltf sceneOfGltf(const fs::path& file) {
    GltfScene scene(file);
    return withSentence(scene, [&] {
        const auto id = ours(scene.gltf()["asset"]).value("scene", std::string());
        SceneOfGltf result{.id = id.empty() ? file.stem().string() : id, .beside = std::nullopt, .toml = scene.text()};
        const fs::path beside = file.parent_path() / (id + ".toml");
        std::error_code failed;
        if (!id.empty() && id == fs::path(id).filename() && fs::exists(beside, failed)) result.beside = beside;
        return result;
    });
}

} // namespace shadowbench::exchange
