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

/// "depth=midpoint": a word of one of the parameters of `read`.
FolderCondition conditionOf(const TomlValue& value, const TechniqueFolder& read);

/// A word of a parameter: letters, digits, +, -, . and _.
std::string choice(const TomlValue& value);

/// Whether all words are whole numbers, so that shaders have the number, too.
bool areNumbers(const OneOf& words);

/// What shaders call it.
std::vector<std::string> macrosOf(const Parameter& parameter);

/// A number, or a parameter of `read` that is one.
Amount amountOf(const TomlValue& value, const TechniqueFolder& read);

/// The same within bounds: a number, or a parameter whose range lies within them. Of an IntegerRange whole numbers.
Amount amountWithin(const TomlValue& value, const Domain& bounds, const TechniqueFolder& read);

/// `view` and `[cascades]`, once parameters are read.
void readView(const TomlValue& root, TechniqueFolder& read);

/// The `[[pass]]` entries, once parameters, targets and shaders are read.
void readPasses(const TomlValue& list, TechniqueFolder& read);

} // namespace shadowbench::techniques
