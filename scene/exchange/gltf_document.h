// A glTF 2.0 file's JSON, as the readers of its nodes look into it. Only sources of this folder include this.
#pragma once

#include "scene/exchange/json_values.h"

#include <glm/mat4x4.hpp>
#include <string_view>
#include <toml++/toml.h>

namespace shadowbench::exchange {

/// A member, or an empty object or list where there is none. Throws BadInput for one of another kind.
const Json& member(const Json& json, const char* name);
const Json& listIn(const Json& json, const char* name);

/// What our exporter has added to an element of its files.
const Json& ours(const Json& element);

std::string nameOf(const Json& element);

std::size_t whole(const Json& number);

/// The 3 numbers under `name`.
glm::dvec3 vectorOr(const Json& element, const char* name, const glm::dvec3& otherwise);

/// The same in TOML; what is null is left out.
void insert(toml::table& table, const std::string& key, const Json& value);
toml::table tomlOf(const Json& members);
toml::array tomlOf(const glm::dvec3& v);

class GltfDocument {
public:
    /// Of the bytes of a .gltf or .glb. Throws BadInput, without the file's name, unless it holds glTF 2.0 that asks for
    /// nothing that is not read.
    GltfDocument(std::string_view bytes, bool isBinary);

    [[nodiscard]] const Json& json() const { return json_; }
    [[nodiscard]] bool isExported() const { return !ours(json_.at("asset")).empty(); }

    /// An element of a list of the file. Throws BadInput where it has none of that number.
    [[nodiscard]] const Json& entry(const char* list, const Json& index) const;

private:
    Json json_;
};

/// `list[index]`, named `name` in errors.
const Json& entryOf(const Json& list, const char* name, const Json& index);

} // namespace shadowbench::exchange
