// Options that several verbs have.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace shadowbench {

/// `profile` is a name, for profileNamed().
void addProfileOption(CLI::App& verb, std::string& profile);

/// What draws: it is chosen for this process and for those that it starts.
void addGlOption(CLI::App& verb);

/// `standing` is set where light and casters stand still.
void addStaticOption(CLI::App& verb, bool& standing);

void addSeedOption(CLI::App& verb, std::uint32_t& seed);

} // namespace shadowbench
