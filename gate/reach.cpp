#include "gate/reach.h"

#include "base/error.h"
#include "base/hash.h"
#include "embedded_reach.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace shadowbench::gate {

Reach Reach::own() { return Reach(embedded::reach); }

Reach::Reach(const std::string& text) : text_(text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        Unit unit;
        if (!(words >> name >> unit.hash))
            throw BadInput(fmt::format("a program's reach has a line without hash: \"{}\"", line));
        for (std::string used; words >> used;) unit.used.push_back(used);
        units_[name] = std::move(unit);
    }
}

std::set<std::string> Reach::units(const std::string& technique, const std::string& scene) const {
    const auto folder =
        std::ranges::find_if(units_, [&](const auto& unit) { return unit.first.ends_with("/" + technique); });
    if (folder == units_.end() || !units_.contains("*")) return {};
    std::vector<std::string> open{"*", folder->first, "scene/library/" + scene + ".toml"};
    std::set<std::string> reached;
    while (!open.empty()) {
        const std::string name = open.back();
        open.pop_back();
        const auto unit = units_.find(name);
        if (unit == units_.end() || !reached.insert(name).second) continue; // a scene's file that is not built in
        open.insert(open.end(), unit->second.used.begin(), unit->second.used.end());
    }
    return reached;
}

std::optional<std::string> Reach::key(const std::string& technique, const std::string& scene) const {
    std::string all;
    for (const std::string& name : units(technique, scene)) all += name + " " + units_.at(name).hash + "\n";
    return all.empty() ? std::nullopt : std::optional(hash128(all).text());
}

std::optional<std::string> Reach::hash(const std::string& unit) const {
    const auto found = units_.find(unit);
    return found == units_.end() ? std::nullopt : std::optional(found->second.hash);
}

} // namespace shadowbench::gate
