// Parts of a variant's name, without asking the catalogue: another program's may not be in it.
#pragma once

#include <string>
#include <string_view>

namespace shadowbench::techniques {

/// "pcf" of "pcf:kernel=7", "my:evsm" of "my:evsm:map=512".
inline std::string idOfVariant(std::string_view variant) {
    constexpr std::string_view ofFolder = "my:";
    return std::string(variant.substr(0, variant.find(':', variant.starts_with(ofFolder) ? ofFolder.size() : 0)));
}

} // namespace shadowbench::techniques
