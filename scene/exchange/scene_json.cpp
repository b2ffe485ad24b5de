#include "scene/exchange/json_values.h"
#include "scene/exchange/texts.h"

namespace shadowbench::exchange {
namespace {

Json conventions() {
    return {{"axes", "right-handed, y up"},
            {"units", "metres, degrees"},
            {"matrices", "16 numbers column by column; clip = projection * view * matrix * (x, y, z, 1)"},
            {"clip_space", "OpenGL: x right, y up, z from -w (near) to w (far)"},
            {"rows", "row 0 is the top"},
            {"pixels", "pixel (x, y) is what its centre (x + 0.5, y + 0.5) sees"},
            {"triangles", "counter-clockwise seen from outside; flat"},
            {"visibility", "1 fully lit, 0 fully shadowed; linear"}};
}

Json meshesOf(const Parts& parts) {
    Json list = Json::array();
    for (const Part& part : parts.list())
        list.push_back({{"name", part.name},
                        {"vertices", part.mesh->positions.size()},
                        {"triangles", part.mesh->triangles.size()},
                        {"closed", part.mesh->closed},
                        {"colour", listOf(glm::dvec3(part.colour))}});
    return list;
}

Json nodesJson(const Snapshot& frame, const Parts& parts) {
    Json list = Json::array();
    for (const Node& node : nodesOf(frame, parts))
        list.push_back({{"name", parts.instanceName(node.placement->id)},
                        {"id", node.placement->id},
                        {"mesh", parts.list()[node.part].name},
                        {"matrix", listOf(node.placement->world)}});
    return list;
}

Json frameOf(const Scene& scene, const Parts& parts, int number) {
    const Snapshot frame = snapshot(scene, number);
    const double aspect = static_cast<double>(scene.size.x) / scene.size.y;
    return {{"index", number},
            {"role", number < scene.timeline.still ? "scored" : "moving"},
            {"camera", jsonOf(frame.camera, scene.size)},
            {"light", jsonOf(frame.light)},
            {"view", listOf(frame.camera.view())},
            {"projection", listOf(frame.camera.projection(aspect))},
            {"nodes", nodesJson(frame, parts)}};
}

} // namespace

std::string sceneJsonOf(const Scene& scene, const Parts& parts, const std::vector<int>& frames, const FileNames& files) {
    Json json{{"format", "shadowbench-scene"},
              {"version", 1},
              {"scene", scene.id},
              {"title", scene.title},
              {"profile", name(scene.profile)},
              {"size", {scene.size.x, scene.size.y}},
              {"scene_file", files.toml},
              {"gltf", "scene.gltf"},
              {"obj", "scene.obj"},
              {"files", files.all},
              {"timeline",
               {{"still", scene.timeline.still}, {"moving", scene.timeline.moving}, {"approach", scene.timeline.approach}}},
              {"conventions", conventions()}};
    Json list = Json::array();
    for (const int frame : frames) list.push_back(frameOf(scene, parts, frame));
    if (!files.cards.empty()) json["cards"] = files.cards;
    json["camera"] = list.front()["camera"];
    json["light"] = list.front()["light"];
    json["meshes"] = meshesOf(parts);
    json["frames"] = std::move(list);
    constexpr int kANodeALine = 4;
    return textOf(json, kANodeALine);
}

} // namespace shadowbench::exchange
