#include "scene/exchange/gltf_views.h"

#include "base/error.h"
#include "base/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::exchange {
namespace {

/// Where a camera or a light looks: along its node's −z.
glm::dvec3 forwardOf(const glm::dmat4& world) { return glm::normalize(-glm::dvec3(world[2])); }

std::string textOf(const glm::dvec3& v) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z); }

} // namespace

void GltfViews::add(GltfView view, const std::string& node) {
    if (view.name.empty()) view.name = node.empty() ? kind_ : node;
    view.name = taken_.add(view.name);
    views_.push_back(std::move(view));
}

std::string GltfViews::names() const {
    constexpr std::size_t most = 8; // in a message
    std::vector<std::string> names;
    for (const GltfView& view : views_)
        if (names.size() < most) names.push_back(fmt::format("\"{}\"", view.name));
    if (views_.size() > most) names.emplace_back("…");
    return fmt::format("{}", fmt::join(names, ", "));
}

const GltfView& GltfViews::chosen(const std::optional<std::string>& name, const std::string& file) const {
    if (!name && views_.size() > 1)
        throw BadInput(
            fmt::format("it has {} {}s ({}); choose one in a scene file with the lines gltf = \"{}\" and {} = \"{}\"",
                        views_.size(), kind_, names(), file, kind_, views_.front().name));
    const auto found = name ? std::ranges::find(views_, *name, &GltfView::name) : views_.begin();
    if (found == views_.end()) {
        std::vector<std::string> known;
        for (const GltfView& view : views_) known.push_back(view.name);
        throw BadInput(fmt::format("it has no {} \"{}\"{}; it has {}", kind_, *name, didYouMean(*name, known), names()));
    }
    if (!found->refusal.empty()) throw BadInput(fmt::format("{} \"{}\" {}", kind_, found->name, found->refusal));
    return *found;
}

GltfView cameraOf(const Json& camera, const glm::dmat4& world, double metres, bool exact) {
    const Json& seen = member(camera, "perspective");
    GltfView view{.name = nameOf(camera), .keys = {}};
    view.aspect = seen.value("aspectRatio", 1.0);
    if (const Json& own = ours(camera); exact && !own.empty()) {
        view.keys = tomlOf(own);
        view.keys.erase("aspect");
        return view;
    }
    const glm::dvec3 eye(world[3]), target = eye + forwardOf(world);
    if (seen.empty()) {
        view.refusal =
            fmt::format("is not in perspective; give one that is in a scene file: camera = {{ eye = {}, target = {}, "
                        "fovy = 45, near = 0.1, far = 100 }}",
                        textOf(eye), textOf(target));
        return view;
    }
    view.keys = toml::table{{"eye", tomlOf(eye)},
                            {"target", tomlOf(target)},
                            {"up", tomlOf(glm::normalize(glm::dvec3(world[1])))},
                            {"fovy", glm::degrees(seen.at("yfov").get<double>())},
                            {"near", metres * seen.at("znear").get<double>()}};
    view.isAimed = false;
    view.endless = !seen.contains("zfar");
    if (!view.endless) view.keys.insert("far", metres * seen["zfar"].get<double>());
    return view;
}

GltfView lightOf(const Json& light, const glm::dmat4& world, bool exact) {
    GltfView view{.name = nameOf(light), .keys = {}};
    if (const Json& own = ours(light); exact && !own.empty()) {
        view.keys = tomlOf(own);
        if (own.contains("sky")) view.keys.erase("direction"); // that of all its light, which follows
        return view;
    }
    const auto type = light.at("type").get<std::string>();
    if (type == "directional")
        view.keys = toml::table{{"kind", type}, {"direction", tomlOf(forwardOf(world))}};
    else if (type == "point")
        view.keys = toml::table{{"kind", type}, {"centre", tomlOf(glm::dvec3(world[3]))}};
    else
        view.refusal =
            fmt::format("is of type {}, which no scene has; give it in a scene file without its cone: light = {{ kind "
                        "= \"point\", centre = {} }}",
                        type, textOf(glm::dvec3(world[3])));
    return view;
}

std::string exampleCamera(const Bounds& box) {
    const double across = glm::length(box.high - box.low);
    const glm::dvec3 eye = box.centre() + 1.4 * across * glm::normalize(glm::dvec3(0.5, 0.4, 0.75));
    return fmt::format("camera = {{ eye = {}, target = {}, fovy = 45, near = {:.4g}, far = {:.4g} }}", textOf(eye),
                       textOf(box.centre()), 0.05 * across, 4 * across);
}

std::string exampleLight() { return "light = { kind = \"directional\", direction = [-1, -2, -0.7] }"; }

} // namespace shadowbench::exchange
