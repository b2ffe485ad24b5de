// Behaviours as JSON.
#include "studies/behaviour/behaviour.h"

#include "base/error.h"
#include "base/json_text.h"
#include "embedded_behaviour.h"
#include "studies/json_members.h"

namespace shadowbench {
namespace {

/// Without "variant" it is the technique with its defaults.
Asserted parseAsserted(const Json& json, const std::string& technique, const std::string& what) {
    const JsonMembers members(json, what, {"says", "test", "scene", "variant", "metric"});
    return {members.text("says"), members.text("test"), members.text("scene"),
            members.has("variant") ? members.text("variant") : technique, members.text("metric")};
}

Behaviour parseBehaviour(const Json& json) {
    const bool named = json.contains("technique") && json["technique"].is_string();
    const std::string what = "behaviours: " + (named ? json["technique"].get<std::string>() : "one without technique");
    const JsonMembers members(json, what, {"technique", "strength", "failure"});
    const std::string technique = members.text("technique");
    return {technique, parseAsserted(members.get("strength"), technique, what + ", strength"),
            parseAsserted(members.get("failure"), technique, what + ", failure")};
}

} // namespace

const std::vector<Behaviour>& behaviours() {
    static const std::vector<Behaviour> all = parseBehaviours(embedded::behaviour().front().text);
    return all;
}

std::vector<Behaviour> parseBehaviours(std::string_view json) {
    const Json list = Json::parse(boundedJson(json, "reading behaviours"), nullptr, false);
    if (!list.is_array()) throw BadInput("reading behaviours: not a JSON list");
    std::vector<Behaviour> result;
    for (const Json& behaviour : list) result.push_back(parseBehaviour(behaviour));
    return result;
}

} // namespace shadowbench
