// Reading the JSON that comes with the program (claims, papers): the members of an object, whose mistakes are named.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowbench {

using Json = nlohmann::ordered_json;

/// Throws BadInput: "reading <what>: <complaint>".
[[noreturn]] void refuseJson(const std::string& what, const std::string& complaint);

/// The members of one object; a value that is no object and a key that is not among `known` are errors, and so is a missing
/// or wrong value when it is asked for. `what` says what the object describes: "claims: K4".
class JsonMembers {
public:
    JsonMembers(const Json& object, std::string what, const std::vector<std::string>& known);

    [[nodiscard]] const std::string& what() const { return what_; }
    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const Json& get(const char* key) const;
    [[nodiscard]] std::string text(const char* key) const;
    [[nodiscard]] double number(const char* key) const;
    [[nodiscard]] const Json& list(const char* key) const;
    [[nodiscard]] std::vector<std::string> texts(const char* key) const;

private:
    const Json& object_;
    std::string what_;
};

} // namespace shadowbench
