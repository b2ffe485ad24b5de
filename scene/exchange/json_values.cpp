#include "scene/exchange/json_values.h"

#include "scene/sky.h"

namespace shadowbench::exchange {
namespace {

struct SkyJson {
    Json operator()(const ConstantSky& sky) const { return {{"constant", sky.radiance}}; }
    Json operator()(const HarmonicSky& sky) const { return {{"harmonics", sky.coefficients}}; }
    Json operator()(const ImageSky&) const { return {{"image", "sky.exr"}}; }
};

std::string onOneLine(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// What has no structure below it: numbers, texts and lists of them.
bool isFlat(const Json& value) {
    return !value.is_structured() || value.empty() || (value.is_array() && !value.front().is_structured());
}

void write(std::string& text, const Json& value, int depth, int indent) {
    if (depth == 0 || isFlat(value)) {
        text += onOneLine(value);
        return;
    }
    const auto newLine = [&](int blanks) { text.append(1, '\n').append(static_cast<std::size_t>(blanks), ' '); };
    text += value.is_array() ? "[" : "{";
    bool first = true;
    for (const auto& [key, member] : value.items()) {
        if (!first) text += ',';
        newLine(indent + 1);
        if (value.is_object()) text += onOneLine(Json(key)) + ": ";
        write(text, member, depth - 1, indent + 1);
        first = false;
    }
    newLine(indent);
    text += value.is_array() ? "]" : "}";
}

} // namespace

Json listOf(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

Json listOf(const glm::dmat4& matrix) {
    Json list = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) list.push_back(matrix[column][row]);
    return list;
}

Json jsonOf(const Camera& camera, const glm::ivec2& size) {
    return {{"eye", listOf(camera.eye)},
            {"target", listOf(camera.target)},
            {"up", listOf(camera.up)},
            {"fovy", camera.fovy},
            {"aspect", static_cast<double>(size.x) / size.y},
            {"near", camera.near},
            {"far", camera.far}};
}

Json jsonOf(const Light& light) {
    Json json{{"kind", name(light.kind)}};
    const bool distant = light.kind == LightKind::Directional || light.isEnvironment();
    json[distant ? "direction" : "centre"] = listOf(distant ? light.direction : light.centre);
    if (light.isArea()) json["u"] = listOf(light.u);
    if (light.isArea() && light.kind != LightKind::Line) json["v"] = listOf(light.v);
    if (!light.isEnvironment()) return json;
    json["sky"] = std::visit(SkyJson{}, light.environment->sky);
    json["suns"] = Json::array();
    for (const Sun& sun : light.environment->suns)
        json["suns"].push_back(
            {{"direction", listOf(sun.direction)}, {"diameter", sun.diameter}, {"radiance", sun.radiance}});
    return json;
}

std::string textOf(const Json& value, int depth) {
    std::string text;
    write(text, value, depth, 0);
    return text + "\n";
}

} // namespace shadowbench::exchange
