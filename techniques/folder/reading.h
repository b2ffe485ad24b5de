// What the readers of technique.toml share.
#pragma once

#include "base/toml_value.h"
#include "techniques/folder/description.h"

#include <string>
#include <vector>

namespace shadowbench::techniques {

/// A name that GLSL takes, too.
std::string identifier(const TomlValue& value, const std::string& name);

/// For people, so there is one, in one line.
std::string words(const TomlValue& value);

/// What shaders call it.
std::vector<std::string> macrosOf(const Parameter& parameter);

/// A number, or a parameter of `read` that is one.
Amount amountOf(const TomlValue& value, const TechniqueFolder& read);

/// The `[[pass]]` entries, once parameters, targets and shaders are read.
void readPasses(const TomlValue& list, TechniqueFolder& read);

} // namespace shadowbench::techniques
