#include "site/viewer/cell_data.h"

#include "site/template.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace shadowbench::site {
namespace {

using Json = nlohmann::ordered_json;

/// In a script, and in one that a page holds in itself: no "</script>", no character that ends a line for some readers.
std::string inScript(const Json& value) {
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    return text;
}

Json ofCell(const ShownCell& cell) {
    Json json{
        {"slug", cell.slug}, {"variant", cell.variant}, {"error", cell.error}, {"truth", cell.truth}, {"data", cell.data}};
    if (const auto& frames = cell.sequence)
        json["frames"] = {{"count", frames->count},
                          {"picture", frames->picture},
                          {"truth", frames->truth},
                          {"flicker", frames->flicker},
                          {"moving", truthLabel(frames->moving)}};
    return json;
}

Data pictureRow(const ShownCell& cell, const ShownScene& scene) {
    Data row;
    const auto truth = std::ranges::find(scene.truths, cell.truth, &ShownTruth::name);
    row.set("slug", cell.slug);
    row.set("variant", cell.variant);
    row.set("error", cell.error);
    row.set("scored", !cell.error.empty());
    row.set("scene", scene.title);
    row.set("picture", cell.picture);
    row.set("difference", cell.difference);
    row.set("truth", truth->picture);
    row.set("label", truth->label);
    row.set("width", std::to_string(scene.width));
    row.set("height", std::to_string(scene.height));
    return row;
}

/// Colours of pixels that are not scored (site/viewer/colours.js has the same).
glm::vec3 surfaceColour(float surface) {
    if (surface == 0) return glm::vec3(51, 64, 87) / 255.0F;
    if (surface == 1) return glm::vec3(87, 64, 51) / 255.0F;
    return glm::vec3(150, 60, 170) / 255.0F;
}

/// What it answers: of other renderers' images, the truth of what they mean.
std::string ownTruth(const Record& record) {
    const std::string oracle = record.reference ? record.reference->oracle : "";
    if (oracle == "irradiance" || oracle == "solid-angle") return oracle;
    return oracle == "povray" ? "soft" : "hard";
}

template <class Colour>
Image<glm::vec3> picture(const KeptTruth& truth, const Colour& colour) {
    Image<glm::vec3> result(truth.surface.width(), truth.surface.height());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = truth.surface[i] == 2 ? colour(i) : surfaceColour(truth.surface[i]);
    return result;
}

} // namespace

std::string truthOf(const Record& record, const std::vector<std::string>& truths) {
    for (const std::string& name :
         {record.softReference ? "soft" : ownTruth(record), std::string("hard"), std::string("soft")})
        if (std::ranges::find(truths, name) != truths.end()) return name;
    return truths.front();
}

std::string movingTruthOf(const Record& record) { return record.pixelReference ? "pixel-area" : ownTruth(record); }

std::string truthLabel(const std::string& name) {
    static const std::map<std::string, std::string> labels{
        {"hard", "exact, of the light's centre"},         {"soft", "of the whole light"},
        {"pixel-area", "exact, over each pixel's area"},  {"area", "exact, of the whole light"},
        {"irradiance", "exact, share of the irradiance"}, {"solid-angle", "exact, share of the light's solid angle"}};
    const auto found = labels.find(name);
    return found != labels.end() ? found->second : name;
}

std::string catalogueScript(const ShownScene& scene) {
    Json json{{"scene", scene.slug}, {"title", scene.title}, {"width", scene.width}, {"height", scene.height}};
    if (!scene.shading.empty()) json["shading"] = scene.shading;
    json["truths"] = Json::array();
    for (const ShownTruth& truth : scene.truths)
        json["truths"].push_back(
            {{"name", truth.name}, {"label", truth.label}, {"data", truth.data}, {"edges", truth.hasEdges}});
    json["cells"] = Json::array();
    for (const ShownCell& cell : scene.cells) json["cells"].push_back(ofCell(cell));
    return fmt::format("shadowbench.cells({});\n", inScript(json));
}

std::string cellsPage(const ShownScene& scene, const Link& back) {
    Data data, rows{Data::type::list};
    for (const ShownCell& cell : scene.cells) rows << pictureRow(cell, scene);
    data.set("slug", scene.slug);
    data.set("scene", scene.title);
    data.set("back", "../" + back.address);
    data.set("where", back.title);
    data.set("rows", rows);
    return render("cells.html", data);
}

Image<glm::vec3> differencePicture(const Image<float>& v, const KeptTruth& truth, int gain) {
    const glm::vec3 none(24.0F / 255), falseShadow = glm::vec3(255, 150, 40) / 255.0F,
                                       leak = glm::vec3(80, 170, 255) / 255.0F;
    return picture(truth, [&](std::size_t i) {
        const float error = std::clamp(static_cast<float>(gain) * (v[i] - truth.visibility[i]), -1.0F, 1.0F);
        return none + std::abs(error) * ((error < 0 ? falseShadow : leak) - none);
    });
}

Image<glm::vec3> visibilityPicture(const Image<float>& v, const KeptTruth& truth) {
    return picture(truth, [&](std::size_t i) { return glm::vec3(std::clamp(v[i], 0.0F, 1.0F)); });
}

} // namespace shadowbench::site
