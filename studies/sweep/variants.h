// Variants of a technique that differ in one parameter.
#pragma once

#include "techniques/contract/entry.h"

#include <string>
#include <string_view>

namespace shadowbench {

/// The parameter's declaration; null if the technique has none of that name.
const techniques::Parameter* parameterOf(const techniques::Variant& variant, std::string_view name);

/// The variant with one of its parameters set to `value`. Throws BadInput for a value outside the parameter's domain.
techniques::Variant withParameter(const techniques::Variant& variant, std::string_view name, const std::string& value);

} // namespace shadowbench
