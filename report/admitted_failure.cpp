// Where techniques fail, from the list that studies/behaviour reads whole and holds to tests.
#include "report/summary.h"

#include "embedded_behaviour.h"

#include <map>
#include <nlohmann/json.hpp>

namespace shadowbench::report {

std::string admittedFailure(const std::string& technique) {
    static const std::map<std::string, std::string> failures = [] {
        std::map<std::string, std::string> result;
        for (const auto& behaviour : nlohmann::json::parse(embedded::behaviour().front().text))
            result[behaviour.at("technique")] = behaviour.at("failure").at("says");
        return result;
    }();
    const auto found = failures.find(technique);
    return found == failures.end() ? "" : found->second;
}

} // namespace shadowbench::report
