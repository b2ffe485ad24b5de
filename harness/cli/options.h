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

void addSeedOption(CLI::App& verb, std::uint32_t& seed);

} // namespace shadowbench
