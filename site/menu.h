// The menu of every page.
#pragma once

#include "harness/records/record.h"

#include <string>
#include <vector>

namespace shadowbench::site {

struct Link {
    std::string title, address; // from the site's folder
};

struct LinkGroup {
    std::string title;
    std::vector<Link> links;
};

/// The pages of the records' scenes, sorted into the standard ones, those on which techniques fail, those at other sizes and
/// the user's own; groups without a scene are left out.
std::vector<LinkGroup> sceneGroups(const std::vector<Record>& records);

/// What follows a scene's name where its records were measured at another profile or size than its first ones: ", paper,
/// 700²".
std::string sizeSuffix(const Record& record);

} // namespace shadowbench::site
