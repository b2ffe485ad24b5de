#include "base/words.h"
#include "scene/scene.h"

namespace shadowbench {
namespace {

constexpr Words<Profile, 3> profiles{
    "profile", {{{Profile::Gate, "gate"}, {Profile::Standard, "standard"}, {Profile::Paper, "paper"}}}};

} // namespace

const std::vector<std::string>& profileNames() {
    static const std::vector<std::string> names = profiles.all();
    return names;
}

std::string_view name(Profile profile) { return profiles.of(profile); }
Profile profileNamed(std::string_view word) { return profiles.named(word); }

} // namespace shadowbench
