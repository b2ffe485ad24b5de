// Technique folders of the catalogue: the program carries them in itself.
#pragma once

#include "techniques/folder/description.h"

#include <string>
#include <vector>

namespace shadowbench::techniques {

/// Of all ("maps/sm-focused"), whether the catalogue has them or not.
std::vector<std::string> builtInPlaces();

/// The text of techniques/`place`/technique.toml.
std::string builtInText(const std::string& place);

/// What techniques/`place`/technique.toml says ("maps/sm-focused"), read as a user's folder is; its row is the plain id.
TechniqueFolder builtInFolder(const std::string& place);

} // namespace shadowbench::techniques
