#include "scene/scene.h"

#include "base/error.h"
#include "base/files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {

const std::vector<std::string>& profileNames() {
    static const std::vector<std::string> names{"gate", "standard", "paper"};
    return names;
}

std::string_view name(Profile profile) {
    switch (profile) {
    case Profile::Gate:
        return "gate";
    case Profile::Standard:
        return "standard";
    case Profile::Paper:
        break;
    }
    return "paper";
}

Profile profileNamed(std::string_view word) {
    for (const Profile profile : {Profile::Gate, Profile::Standard, Profile::Paper})
        if (name(profile) == word) return profile;
    throw BadInput(fmt::format("unknown profile \"{}\"{}; known are {}", word, didYouMean(word, profileNames()),
                               fmt::join(profileNames(), ", ")));
}

} // namespace shadowbench
