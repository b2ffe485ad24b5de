// An inspection as lines for a terminal and as JSON.
#include "harness/inspect/inspection.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace shadowbench::inspect {
namespace {

using nlohmann::ordered_json;

constexpr const char* kAxes = "xyz";

std::string share(double value) { return fmt::format("{:.1f} %", 100 * value); }

std::string lengths(const glm::dvec3& size) { return fmt::format("{:.4g} × {:.4g} × {:.4g} m", size.x, size.y, size.z); }

std::string point(const glm::dvec3& p) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z); }

std::string line(const char* label, const std::string& text) { return fmt::format("  {:<9} {}\n", label, text); }

/// What the shape of the mesh is, whatever is said of it.
std::string foundOf(const MeshFaults& faults) {
    if (!faults.edges.closed()) return "open";
    return faults.volume < 0 ? "closed, turned inside out" : "closed";
}

std::string faultsOf(const MeshFaults& faults) {
    std::string text;
    const auto add = [&](const Fault& fault, const char* what, const char* remedy = "") {
        if (fault.count > 0)
            text += line("", fmt::format("{}: {}, the first near {}{}", what, fault.count, point(fault.place), remedy));
    };
    add(faults.edges.open, "edges of one triangle");
    add(faults.edges.crowded, "edges of more than two triangles");
    add(faults.edges.turned, "edges whose two triangles face opposite ways");
    add(faults.turnedParts, "parts that are turned inside out");
    add(faults.flat, "triangles of no area, which are left out",
        "; delete them in the modelling program (Blender: Mesh > Clean Up > Degenerate Dissolve)");
    add(faults.repeated, "triangles with the corners of another");
    add(faults.doubled, "vertices at the place of another");
    return text;
}

std::string textOf(const MeshReport& mesh) {
    const std::string count = mesh.instances > 1 ? fmt::format("{} × ", mesh.instances) : "";
    return line("object", fmt::format("{}: {}{} triangles, {}, {}closed, found {}", mesh.name, count, mesh.triangles,
                                      lengths(mesh.box.high - mesh.box.low),
                                      mesh.saidClosed ? "said to be " : "not said to be ", foundOf(mesh.faults))) +
           faultsOf(mesh.faults);
}

std::string placeOf(const Light& light) {
    if (light.isEnvironment()) return "all around";
    if (light.kind == LightKind::Directional) return "towards " + point(light.direction);
    return "at " + point(light.centre);
}

std::string textOf(const FrameReport& frame) {
    std::string text =
        fmt::format("{} × {}: {} of the pixels are receivers, {} face away from the light, {} see nothing", frame.size.x,
                    frame.size.y, share(frame.receivers), share(frame.facesAway), share(frame.background));
    if (frame.lightPoints == 0 || frame.receivers == 0) return line("frame", text);
    std::string labels = fmt::format("of the receivers {} are lit, {} shadowed", share(frame.lit), share(frame.shadowed));
    if (frame.lightPoints > 1)
        labels += fmt::format(", {} in penumbra (from {} points of the light: at least)", share(frame.penumbra),
                              frame.lightPoints);
    return line("frame", text) + line("", labels);
}

ordered_json listOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

ordered_json jsonOf(const Fault& fault) {
    if (fault.count == 0) return {{"count", 0}};
    return {{"count", fault.count}, {"first", listOf(fault.place)}};
}

ordered_json jsonOf(const MeshReport& mesh) {
    const MeshFaults& faults = mesh.faults;
    return {{"name", mesh.name},
            {"instances", mesh.instances},
            {"triangles", mesh.triangles},
            {"size", listOf(mesh.box.high - mesh.box.low)},
            {"said_closed", mesh.saidClosed},
            {"found_closed", faults.edges.closed()},
            {"volume", faults.volume},
            {"open_edges", jsonOf(faults.edges.open)},
            {"crowded_edges", jsonOf(faults.edges.crowded)},
            {"turned_edges", jsonOf(faults.edges.turned)},
            {"turned_parts", jsonOf(faults.turnedParts)},
            {"flat_triangles", jsonOf(faults.flat)},
            {"repeated_triangles", jsonOf(faults.repeated)},
            {"doubled_vertices", jsonOf(faults.doubled)}};
}

ordered_json jsonOf(const FrameReport& frame) {
    ordered_json json{{"size", {frame.size.x, frame.size.y}},
                      {"receivers", frame.receivers},
                      {"faces_away", frame.facesAway},
                      {"background", frame.background},
                      {"light_points", frame.lightPoints}};
    if (frame.lightPoints > 0) json.update({{"lit", frame.lit}, {"shadowed", frame.shadowed}, {"penumbra", frame.penumbra}});
    return json;
}

} // namespace

std::string textOf(const Inspection& i, const std::string& picture) {
    const glm::dvec3 size = i.box.high - i.box.low;
    std::string text = fmt::format("{} ({}): {}\n", i.scene, name(i.profile), i.title);
    if (!picture.empty()) text += line("picture", picture);
    if (i.moved != glm::dvec3(0))
        text +=
            line("moved", fmt::format("by ({:.12g}, {:.12g}, {:.12g}), to the origin; what follows is of the moved scene",
                                      i.moved.x, i.moved.y, i.moved.z));
    text += line("size", fmt::format("{}, {:.4g} m across, from {} to {}", lengths(size), glm::length(size),
                                     point(i.box.low), point(i.box.high)));
    text += line("camera",
                 fmt::format("at {}, {}; it looks at what is {:.4g} m away; near {:g}, far {:g} m", point(i.camera.eye),
                             i.toScene == 0 ? "within the scene's box" : fmt::format("{:.4g} m from the scene", i.toScene),
                             glm::distance(i.camera.eye, i.camera.target), i.camera.near, i.camera.far));
    text += line("up", fmt::format("the camera's is {}; the largest flat surface lies across {}", point(i.camera.up),
                                   kAxes[i.upAxis]));
    text += line("light", fmt::format("{}, {}", name(i.light.kind), placeOf(i.light)));
    for (const MeshReport& mesh : i.meshes) text += textOf(mesh);
    text += textOf(i.frame);
    if (i.texels)
        text += line("map", fmt::format("a texel of a uniform one of 1024² covers {:.2g} pixels (median), {:.2g} (95 %)",
                                        i.texels->median, i.texels->p95));
    for (const Warning& warning : i.warnings) text += "  " + lineOf(warning) + "\n";
    return text;
}

std::string jsonOf(const Inspection& i, const std::string& picture) {
    ordered_json json{{"scene", i.scene}, {"title", i.title}, {"profile", name(i.profile)}};
    if (!picture.empty()) json["picture"] = picture;
    json["moved"] = listOf(i.moved);
    json["box"] = {{"low", listOf(i.box.low)}, {"high", listOf(i.box.high)}};
    json["camera"] = {{"eye", listOf(i.camera.eye)}, {"target", listOf(i.camera.target)},
                      {"up", listOf(i.camera.up)},   {"to_scene", i.toScene},
                      {"near", i.camera.near},       {"far", i.camera.far}};
    json["up_axis"] = std::string(1, kAxes[i.upAxis]);
    json["light"] = name(i.light.kind);
    json["meshes"] = ordered_json::array();
    for (const MeshReport& mesh : i.meshes) json["meshes"].push_back(jsonOf(mesh));
    json["frame"] = jsonOf(i.frame);
    if (i.texels) json["texels"] = {{"median", i.texels->median}, {"p95", i.texels->p95}, {"mapped", i.texels->mapped}};
    json["warnings"] = ordered_json::array();
    for (const Warning& warning : i.warnings)
        json["warnings"].push_back({{"what", warning.what}, {"remedy", warning.remedy}});
    return json.dump(2);
}

} // namespace shadowbench::inspect
