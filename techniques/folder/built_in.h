// Technique folders of the catalogue: the program carries them in itself.
#pragma once

#include "techniques/folder/description.h"

#include <string>

namespace shadowbench::techniques {

/// What techniques/`place`/technique.toml says ("maps/sm-focused"), read as a user's folder is; its row is the plain id.
TechniqueFolder builtInFolder(const std::string& place);

} // namespace shadowbench::techniques
