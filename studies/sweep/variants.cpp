#include "studies/sweep/variants.h"

#include "techniques/catalog.h"

#include <algorithm>

namespace shadowbench {

const techniques::Parameter* parameterOf(const techniques::Variant& variant, std::string_view name) {
    const auto& declared = variant.entry->parameters;
    const auto found = std::ranges::find_if(declared, [&](const auto& parameter) { return parameter.name == name; });
    return found == declared.end() ? nullptr : &*found;
}

techniques::Variant withParameter(const techniques::Variant& variant, std::string_view name, const std::string& value) {
    std::string text = variant.entry->id;
    char before = ':';
    for (const auto& [parameter, set] : variant.parameters.all()) {
        text += before + parameter + "=" + (parameter == name ? value : set);
        before = ',';
    }
    return techniques::parseVariant(text);
}

} // namespace shadowbench
