#include "site/menu.h"

#include "report/summary.h"
#include "scene/load/load.h"
#include "site/names.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

std::string groupOf(const Record& record) {
    const auto isAmong = [&](const std::vector<std::string>& ids) {
        return std::ranges::find(ids, record.scene) != ids.end();
    };
    if (record.scene.ends_with(sizeSuffix(record)))
        return record.profile == "paper" ? "At the papers' sizes" : fmt::format("At {}", report::imageSize(record));
    if (isAmong(standardScenes())) return "Standard scenes";
    return isAmong(builtinScenes()) ? "Where techniques fail" : "Own scenes";
}

} // namespace

std::string sizeSuffix(const Record& record) { return fmt::format(", {}, {}", record.profile, report::imageSize(record)); }

std::vector<LinkGroup> sceneGroups(const std::vector<Record>& records) {
    std::vector<LinkGroup> groups{{"Standard scenes", {}}, {"Where techniques fail", {}}, {"Own scenes", {}}};
    for (const std::string& scene : report::scenes(records)) {
        const std::string title = truncate(groupOf(records[report::ofScene(records, scene).front()]));
        auto group = std::ranges::find(groups, title, &LinkGroup::title);
        if (group == groups.end()) group = groups.insert(groups.end(), {title, {}});
        group->links.push_back({scene, sceneAddress(scene)});
    }
    std::erase_if(groups, [](const LinkGroup& group) { return group.links.empty(); });
    return groups;
}

} // namespace shadowbench::site
