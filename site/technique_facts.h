// What the catalogue says of a technique, for filters and captions.
#pragma once

#include <string>

namespace shadowbench::site {

struct TechniqueFacts {
    std::string title;  // "Percentage-closer soft shadows"; the id of one that the catalogue lacks
    std::string family; // by its id (report/families.h): "soft"
    std::string answer; // "hard", "filtered", "soft", "colour", "other"
    std::string lacks;  // needs (techniques/contract/need.h): "any-eye, open-meshes"
};
TechniqueFacts factsOf(const std::string& technique);

} // namespace shadowbench::site
