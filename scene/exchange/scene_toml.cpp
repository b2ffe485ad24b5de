// The writer of scene files, the inverse of scene/load/scene_file.cpp: every number is the one that was loaded.
#include "scene/exchange/texts.h"
#include "scene/sky.h"

#include <cmath>
#include <map>
#include <sstream>
#include <toml++/toml.h>

namespace shadowbench::exchange {
namespace {

toml::array listOf(const glm::dvec3& v) { return toml::array{v.x, v.y, v.z}; }

toml::array listOf(const glm::dmat4& matrix) {
    toml::array list;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.push_back(matrix[column][row]);
    return list;
}

toml::table onOneLine(toml::table table) {
    table.is_inline(true);
    return table;
}

/// Several tracks as one list of keys, by frame: `{ frame, name = value, … }`.
class Path {
public:
    void add(const Track& track, const char* name) {
        for (const Track::Key& key : track.keys) keys_[key.frame].insert_or_assign(name, listOf(key.value));
    }

    /// As `path` of `table`; nothing where no track has a key.
    void addTo(toml::table& table) const {
        toml::array list;
        for (const auto& [frame, values] : keys_) {
            toml::table key = values;
            key.insert_or_assign("frame", frame);
            list.push_back(onOneLine(std::move(key)));
        }
        if (!list.empty()) table.insert_or_assign("path", std::move(list));
    }

private:
    std::map<double, toml::table> keys_;
};

void addCameraPath(const Track& eye, const Track& target, toml::table& table) {
    Path path;
    path.add(eye, "eye");
    path.add(target, "target");
    path.addTo(table);
}

toml::table cameraOf(const Scene& scene) {
    const Camera& camera = scene.camera;
    toml::table table{{"eye", listOf(camera.eye)}, {"target", listOf(camera.target)},
                      {"up", listOf(camera.up)},   {"fovy", camera.fovy},
                      {"near", camera.near},       {"far", camera.far}};
    addCameraPath(scene.eye, scene.target, table);
    return table;
}

struct SkyTable {
    toml::table operator()(const ConstantSky& sky) const { return toml::table{{"constant", sky.radiance}}; }
    toml::table operator()(const HarmonicSky& sky) const {
        toml::array list;
        for (const double coefficient : sky.coefficients) list.push_back(coefficient);
        return toml::table{{"harmonics", std::move(list)}};
    }
    toml::table operator()(const ImageSky&) const { return toml::table{{"image", "sky.exr"}}; }
};

void addEnvironment(const EnvironmentLight& environment, toml::table& table) {
    table.insert("sky", onOneLine(std::visit(SkyTable{}, environment.sky)));
    toml::array suns;
    for (const Sun& sun : environment.suns)
        suns.push_back(onOneLine(
            toml::table{{"direction", listOf(sun.direction)}, {"diameter", sun.diameter}, {"radiance", sun.radiance}}));
    if (!suns.empty()) table.insert("suns", std::move(suns));
}

toml::table lightOf(const Scene& scene) {
    const Light& light = scene.light;
    toml::table table{{"kind", name(light.kind)}};
    if (light.isEnvironment()) {
        addEnvironment(*light.environment, table);
        return table;
    }
    const bool directional = light.kind == LightKind::Directional;
    const char* moved = directional ? "direction" : "centre";
    table.insert(moved, listOf(directional ? light.direction : light.centre));
    if (light.isArea()) table.insert("u", listOf(light.u));
    if (light.isArea() && light.kind != LightKind::Line) table.insert("v", listOf(light.v));
    Path path;
    path.add(directional ? scene.lightDirection : scene.lightCentre, moved);
    path.addTo(table);
    return table;
}

toml::table levelOf(const Object& object, std::size_t number, const Parts& parts) {
    const Level& level = object.levels[number];
    const auto nameOf = [&](const auto& mesh) { return parts.nameOf(mesh.get(), object.shown(number)); };
    toml::table mesh{{"file", "scene.gltf"}, {"closed", level.mesh->closed}};
    toml::array poses;
    for (const auto& pose : object.poses) poses.push_back(nameOf(pose));
    if (poses.empty())
        mesh.insert("part", nameOf(level.mesh));
    else
        mesh.insert("poses", std::move(poses));
    toml::table table{{"mesh", onOneLine(std::move(mesh))}};
    if (std::isfinite(level.until)) table.insert("until", level.until);
    if (level.colour) table.insert("colour", listOf(glm::dvec3(*level.colour)));
    return onOneLine(std::move(table));
}

void addSpin(const Object& object, toml::table& table) {
    toml::array phases;
    bool turned = object.motion.degreesPerFrame != 0;
    for (const Instance& instance : object.instances) {
        phases.push_back(instance.phase);
        turned = turned || instance.phase != 0;
    }
    if (!turned) return;
    table.insert("spin", toml::table{{"axis", listOf(object.motion.axis)},
                                     {"degrees_per_frame", object.motion.degreesPerFrame},
                                     {"phase", std::move(phases)}});
}

void addStartPoses(const Object& object, toml::table& table) {
    if (object.poses.empty()) return;
    toml::array poses;
    for (const Instance& instance : object.instances) poses.push_back(instance.pose);
    table.insert("pose", std::move(poses));
}

toml::table objectOf(const Object& object, const Parts& parts) {
    toml::array levels, places;
    for (std::size_t i = 0; i < object.levels.size(); ++i) levels.push_back(levelOf(object, i, parts));
    for (const Instance& instance : object.instances)
        places.push_back(onOneLine(toml::table{{"matrix", listOf(instance.place)}}));
    toml::table table{{"name", object.name},
                      {"colour", listOf(glm::dvec3(object.colour))},
                      {"levels", std::move(levels)},
                      {"place", std::move(places)}};
    addSpin(object, table);
    addStartPoses(object, table);
    Path path;
    path.add(object.motion.shift, "shift");
    path.addTo(table);
    return table;
}

toml::table lodOf(const LodWalk& walk) {
    toml::table table{{"frames", walk.frames}, {"band", walk.band}};
    addCameraPath(walk.eye, walk.target, table);
    return table;
}

toml::table expectOf(const Scene& scene) {
    toml::array fails, holds, breaks, never;
    for (const auto& [technique, bound, reason] : scene.expectations)
        (bound.below ? holds : fails)
            .push_back(onOneLine(toml::table{{"technique", technique},
                                             {"metric", bound.metric},
                                             {bound.below ? "below" : "above", bound.value},
                                             {"reason", reason}}));
    for (const BreakExpectation& one : scene.breaks) {
        toml::table entry{{"technique", one.technique}, {"axis", one.axis}, {"reason", one.reason}};
        if (one.between) entry.insert("between", toml::array{one.between->x, one.between->y});
        (one.between ? breaks : never).push_back(onOneLine(std::move(entry)));
    }
    return toml::table{{"fails", std::move(fails)},
                       {"holds", std::move(holds)},
                       {"breaks", std::move(breaks)},
                       {"never_breaks", std::move(never)}};
}

} // namespace

std::string tomlOf(const Scene& scene, const Parts& parts) {
    toml::array objects;
    for (const Object& object : scene.objects) objects.push_back(objectOf(object, parts));
    toml::table tolerance;
    for (const auto& [metric, worst] : scene.tolerance) tolerance.insert(metric, worst);
    toml::table root{{"title", scene.title},
                     {"profile", name(scene.profile)},
                     {"size", toml::array{scene.size.x, scene.size.y}},
                     {"reference_samples", scene.referenceSamples},
                     {"moving_reference_samples", scene.movingReferenceSamples},
                     {"camera", cameraOf(scene)},
                     {"light", lightOf(scene)},
                     {"timeline", toml::table{{"still", scene.timeline.still},
                                              {"moving", scene.timeline.moving},
                                              {"approach", scene.timeline.approach}}},
                     {"object", std::move(objects)}};
    if (!tolerance.empty()) root.insert("tolerance", std::move(tolerance));
    if (!scene.expectations.empty() || !scene.breaks.empty()) root.insert("expect", expectOf(scene));
    if (scene.lod) root.insert("lod", lodOf(*scene.lod));

    std::ostringstream text;
    if (!scene.shows.empty()) text << "# " << scene.shows << "\n"; // the loader takes the first comment for it
    // A text over several lines could hold one that begins with '#', which the loader would take for that comment.
    text << toml::toml_formatter(root, toml::toml_formatter::default_flags & ~toml::format_flags::allow_multi_line_strings)
         << "\n";
    return text.str();
}

} // namespace shadowbench::exchange
