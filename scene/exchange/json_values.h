// Vectors, cameras and lights as the JSON of scene.json and of glTF's extras. Only sources of this folder include this: it
// brings nlohmann's JSON.
#pragma once

#include "scene/camera.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace shadowbench::exchange {

using Json = nlohmann::ordered_json;

Json listOf(const glm::dvec3& vector);
Json listOf(const glm::dmat4& matrix); // 16 numbers, column by column

/// eye, target, up, fovy (degrees), aspect, near and far.
Json jsonOf(const Camera& camera, const glm::ivec2& size);

/// `kind` and what it has (docs/exchange.md, "Lights"). The sky of an image is named `sky.exr`.
Json jsonOf(const Light& light);

/// Indented by `depth` levels; what lies deeper, and a list of numbers or texts, stands on one line. Ends with a new line.
/// Doubles have as many digits as name the same number; bytes that are no UTF-8 are replaced.
std::string textOf(const Json& value, int depth);

} // namespace shadowbench::exchange
