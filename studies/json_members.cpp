#include "studies/json_members.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {

void refuseJson(const std::string& what, const std::string& complaint) {
    throw BadInput(fmt::format("reading {}: {}", what, complaint));
}

JsonMembers::JsonMembers(const Json& object, std::string what, const std::vector<std::string>& known)
    : object_(object), what_(std::move(what)) {
    if (!object.is_object()) refuseJson(what_, "an object is expected, not " + object.dump());
    for (const auto& [key, value] : object.items())
        if (std::ranges::find(known, key) == known.end()) refuseJson(what_, fmt::format("\"{}\" is no key", key));
}

const Json& JsonMembers::get(const char* key) const {
    if (!has(key)) refuseJson(what_, fmt::format("\"{}\" is missing", key));
    return object_[key];
}

std::string JsonMembers::text(const char* key) const {
    const Json& value = get(key);
    if (!value.is_string()) refuseJson(what_, fmt::format("\"{}\" must be text", key));
    return value.get<std::string>();
}

double JsonMembers::number(const char* key) const {
    const Json& value = get(key);
    if (!value.is_number()) refuseJson(what_, fmt::format("\"{}\" must be a number", key));
    return value.get<double>();
}

const Json& JsonMembers::list(const char* key) const {
    const Json& value = get(key);
    if (!value.is_array()) refuseJson(what_, fmt::format("\"{}\" must be a list", key));
    return value;
}

std::vector<std::string> JsonMembers::texts(const char* key) const {
    std::vector<std::string> result;
    for (const Json& value : list(key)) {
        if (!value.is_string()) refuseJson(what_, fmt::format("\"{}\" must list texts", key));
        result.push_back(value.get<std::string>());
    }
    return result;
}

} // namespace shadowbench
