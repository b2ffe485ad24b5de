#include "harness/foreign/timing_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowbench::foreign {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& what) {
    throw Inconclusive(
        fmt::format("its timing.json {}; it is {{\"milliseconds\": 1.25, \"device\": \"…\"}}, or milliseconds "
                    "is a list of the frames' times",
                    what));
}

double timeIn(const Json& json) {
    if (!json.is_number()) refuse("has a time that is no number: " + json.dump());
    const double time = json.get<double>();
    if (!std::isfinite(time) || time <= 0) refuse("has a time that is not above 0: " + json.dump());
    return time;
}

double medianOf(const Json& json) {
    if (!json.is_array()) return timeIn(json);
    std::vector<double> times;
    for (const Json& item : json) times.push_back(timeIn(item));
    if (times.empty()) refuse("has no times: milliseconds is []");
    std::ranges::sort(times);
    return 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
}

} // namespace

std::optional<ReportedCost> reportedCost(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return {};
    const Json json = Json::parse(boundedJson(readFile(file), file.string()), nullptr, false);
    if (!json.is_object()) refuse("is no JSON object");
    const std::vector<std::string> known{"milliseconds", "device"};
    for (const auto& [key, value] : json.items())
        if (std::ranges::find(known, key) == known.end())
            refuse(fmt::format("has an unknown key \"{}\"{}", key, didYouMean(key, known)));
    if (!json.contains("milliseconds")) refuse("lacks \"milliseconds\"");
    ReportedCost cost;
    cost.milliseconds = medianOf(json["milliseconds"]);
    if (json.contains("device")) {
        if (!json["device"].is_string()) refuse("has a device that is no text: " + json["device"].dump());
        cost.device = json["device"];
    }
    return cost;
}

} // namespace shadowbench::foreign
