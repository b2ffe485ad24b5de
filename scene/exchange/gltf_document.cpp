#include "scene/exchange/gltf_document.h"

#include "base/error.h"
#include "base/json_text.h"
#include "scene/gltf_file.h"

#include <cstdint>
#include <fmt/format.h>

namespace shadowbench::exchange {
namespace {

const Json none = Json::object();
const Json noList = Json::array();

void append(toml::array& list, const Json& value) {
    toml::table holder;
    insert(holder, "it", value);
    if (const toml::node* made = holder.get("it")) list.push_back(*made);
}

} // namespace

const Json& member(const Json& json, const char* name) {
    const auto found = json.find(name);
    if (found == json.end()) return none;
    if (!found->is_object()) throw BadInput(fmt::format("\"{}\" is no object; export it again", name));
    return *found;
}

const Json& listIn(const Json& json, const char* name) {
    const auto found = json.find(name);
    if (found == json.end()) return noList;
    if (!found->is_array()) throw BadInput(fmt::format("\"{}\" is no list; export it again", name));
    return *found;
}

const Json& ours(const Json& element) {
    const auto extras = element.find("extras"); // which others fill with what they like
    if (extras == element.end() || !extras->is_object()) return none;
    return member(*extras, "shadowbench");
}

std::string nameOf(const Json& element) { return element.value("name", std::string()); }

std::size_t whole(const Json& number) { return wholeNumber<std::size_t>(number); }

glm::dvec3 vectorOr(const Json& element, const char* name, const glm::dvec3& otherwise) {
    const Json& list = listIn(element, name);
    return list.empty() ? otherwise : glm::dvec3(list.at(0), list.at(1), list.at(2));
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
    if (value.is_object()) table.insert(key, tomlOf(value));
}

toml::table tomlOf(const Json& members) {
    toml::table table;
    for (const auto& [name, value] : members.items()) insert(table, name, value);
    return table;
}

toml::array tomlOf(const glm::dvec3& v) { return toml::array{v.x, v.y, v.z}; }

GltfDocument::GltfDocument(std::string_view bytes, bool isBinary) {
    const std::string_view text = isBinary ? glbChunks(bytes).json : bytes;
    json_ = Json::parse(boundedJson(text, "its JSON"), nullptr, false);
    if (!json_.is_object()) throw BadInput("it is not valid JSON");
    if (member(json_, "asset").value("version", Json()) != "2.0") throw BadInput("it is no glTF 2.0; export it as that");
    for (const Json& extension : listIn(json_, "extensionsRequired")) requireHarmless(extension.get<std::string>());
}

const Json& GltfDocument::entry(const char* list, const Json& index) const {
    return entryOf(listIn(json_, list), list, index);
}

const Json& entryOf(const Json& list, const char* name, const Json& index) {
    if (!index.is_number_integer())
        throw BadInput(fmt::format("{} is no number of one of its {}; export it again", index.dump(), name));
    const std::size_t at = whole(index);
    if (at >= list.size()) throw BadInput(fmt::format("it has no {}[{}]; export it again", name, at));
    return list[at];
}

} // namespace shadowbench::exchange
