// A glTF file as a scene: its meshes where its nodes put them, its camera and its light, at rest.
#include "base/error.h"
#include "base/files.h"
#include "scene/exchange/gltf.h"
#include "scene/exchange/gltf_objects.h"
#include "scene/exchange/gltf_views.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <sstream>
#include <vector>

namespace shadowbench::exchange {
namespace {

namespace fs = std::filesystem;

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

/// From the file's unit and axes to metres with +y up.
glm::dmat4 rootOf(const GltfUse& use) {
    glm::dmat4 root(use.metres);
    root[3][3] = 1;
    if (use.zUp) {
        root[1] = glm::dvec4(0, 0, -use.metres, 0);
        root[2] = glm::dvec4(0, use.metres, 0, 0);
    }
    return root;
}

class SceneReader {
public:
    SceneReader(const GltfDocument& gltf, const GltfUse& use) : gltf_(gltf), use_(use) {}

    std::string text(const std::string& title) {
        const Json& json = gltf_.json();
        const Json shown = json.contains("scene") ? json["scene"] : Json(0);
        visitAll(listIn(gltf_.entry("scenes", shown), "nodes"));
        if (objects_.empty()) throw BadInput("no node of it shows a triangle; points and lines cast no shadow");
        requireViews();
        toml::table scene{{"title", title}, {"timeline", toml::table{{"moving", 0}}}};
        for (const char* name : {"profile", "size"})
            if (const Json& own = ours(json["asset"]); own.contains(name)) insert(scene, name, own[name]);
        if (!use_.hasCamera) addCamera(scene);
        if (!use_.hasLight) scene.insert("light", lights_.chosen(use_.light, use_.file).keys);
        scene.insert("object", objects_.take());
        std::ostringstream text;
        text << scene << "\n";
        return text.str();
    }

private:
    /// A node to be visited, and what its parent is in the world.
    struct Waiting {
        const Json* index;
        glm::dmat4 parent;
    };

    /// Depth first, in the order of the file. Without recursion: chains of nodes may be long.
    void visitAll(const Json& roots) {
        std::vector<Waiting> waiting;
        std::size_t met = 0;
        const auto add = [&](const Json& list, const glm::dmat4& parent) {
            met += list.size();
            if (met > listIn(gltf_.json(), "nodes").size()) throw BadInput("its nodes are no tree; export it again");
            for (std::size_t i = list.size(); i-- > 0;) waiting.push_back({&list[i], parent});
        };
        add(roots, rootOf(use_));
        while (!waiting.empty()) {
            const Waiting next = waiting.back();
            waiting.pop_back();
            const Json& node = gltf_.entry("nodes", *next.index);
            const glm::dmat4 world = next.parent * localOf(node);
            visit(node, world);
            add(listIn(node, "children"), world);
        }
    }

    void visit(const Json& node, const glm::dmat4& world) {
        if (node.contains("mesh")) objects_.add(node["mesh"], world, nameOf(node));
        if (node.contains("camera"))
            cameras_.add(cameraOf(gltf_.entry("cameras", node["camera"]), world, use_.metres, isExact_), nameOf(node));
        const char* punctual = "KHR_lights_punctual";
        if (const Json& light = member(member(node, "extensions"), punctual); light.contains("light")) {
            const Json& lights = listIn(member(member(gltf_.json(), "extensions"), punctual), "lights");
            lights_.add(lightOf(entryOf(lights, "lights", light["light"]), world, isExact_), nameOf(node));
        }
    }

    /// Names all that is missing at once, as the lines to be written.
    void requireViews() const {
        std::vector<std::string> missing, lines{fmt::format("gltf = \"{}\"", use_.file)};
        if (!use_.hasCamera && cameras_.empty()) {
            missing.emplace_back("camera");
            Bounds box = objects_.bounds().value_or(Bounds{glm::dvec3(-1), glm::dvec3(1)});
            lines.push_back(exampleCamera(box));
        }
        if (!use_.hasLight && lights_.empty()) {
            missing.emplace_back("light (of KHR_lights_punctual)");
            lines.push_back(exampleLight());
        }
        if (missing.empty()) return;
        throw BadInput(
            fmt::format("it has no {}; export it with cameras and punctual lights, or give them in a scene file with "
                        "the lines {}",
                        fmt::join(missing, " and no "), fmt::join(lines, " and ")));
    }

    void addCamera(toml::table& scene) const {
        const GltfView& view = cameras_.chosen(use_.camera, use_.file);
        toml::table camera = view.keys;
        if (view.endless) camera.insert("far", reachOf(view));
        if (!view.isAimed) aim(camera);
        scene.insert("camera", std::move(camera));
        if (!scene.contains("size")) scene.insert("size", sizeOf(view));
    }

    static glm::dvec3 pointIn(const toml::table& camera, const char* key) {
        glm::dvec3 point;
        for (int i = 0; i < 3; ++i) point[i] = camera[key][static_cast<std::size_t>(i)].value_or(0.0);
        return point;
    }

    /// Puts the target as far away as the middle of the scene, if that is ahead: other views turn about it, and how large a
    /// scene looks is judged by it.
    void aim(toml::table& camera) const {
        if (!objects_.bounds()) return;
        const glm::dvec3 eye = pointIn(camera, "eye"), forward = pointIn(camera, "target") - eye; // 1 m long
        const double depth = glm::dot(objects_.bounds()->centre() - eye, forward);
        if (depth > camera["near"].value_or(0.0)) camera.insert_or_assign("target", tomlOf(eye + depth * forward));
    }

    /// A camera that sees without end sees the whole scene.
    [[nodiscard]] double reachOf(const GltfView& camera) const {
        constexpr double room = 1.01; // so that rounding clips nothing
        if (!objects_.bounds())
            throw BadInput(fmt::format("camera \"{}\" has no zfar, and no min and max of positions say how far the scene "
                                       "reaches; give it an end in the modelling program",
                                       camera.name));
        const glm::dvec3 eye = pointIn(camera.keys, "eye");
        double reach = 2 * camera.keys["near"].value_or(0.0);
        for (const glm::dvec3& corner : objects_.bounds()->corners())
            reach = std::max(reach, room * glm::distance(eye, corner));
        return reach;
    }

    /// As high as the images of the gate profile are, where the camera alone says how wide they are.
    [[nodiscard]] static toml::array sizeOf(const GltfView& camera) {
        constexpr double height = 256, most = 8192;
        const double width = std::round(height * camera.aspect);
        if (!(width >= 1 && width <= most))
            throw BadInput(fmt::format("camera \"{}\" has an aspectRatio of {:g}", camera.name, camera.aspect));
        return toml::array{static_cast<int>(width), static_cast<int>(height)};
    }

    const GltfDocument& gltf_;
    const GltfUse& use_;
    const bool isExact_ =
        use_.metres == 1 && !use_.zUp; // else what the exporter says of a view is no longer where the meshes are
    GltfObjects objects_{gltf_, use_};
    GltfViews cameras_{"camera"}, lights_{"light"};
};

SceneOfGltf read(std::string_view bytes, const fs::path& file, const GltfUse& use) {
    const GltfDocument gltf(bytes, file.extension() == ".glb");
    const auto id = ours(gltf.json()["asset"]).value("scene", std::string());
    const std::string stem = file.stem().string();
    SceneOfGltf result{
        .id = id.empty() ? stem : id, .beside = std::nullopt, .toml = SceneReader(gltf, use).text(id.empty() ? stem : id)};
    const fs::path beside = file.parent_path() / (id + ".toml");
    std::error_code failed;
    if (!id.empty() && id == fs::path(id).filename() && fs::exists(beside, failed)) result.beside = beside;
    return result;
}

} // namespace

SceneOfGltf sceneOfGltf(const fs::path& file, const GltfUse& use) {
    const auto fail = [&](const std::string& sentence) {
        throw BadInput(fmt::format("cannot load {} as a scene: {}", file.string(), sentence));
    };
    const std::string bytes = readFile(file);
    try {
        return read(bytes, file, use);
    } catch (const Json::exception& error) {
        fail(fmt::format("a value is missing or of another kind than glTF asks for ({})", error.what()));
    } catch (const BadInput& error) {
        fail(error.what());
    }
    return {};
}

} // namespace shadowbench::exchange
