#include "harness/cli/options.h"

#include <CLI/CLI.hpp>

namespace shadowbench {

void addProfileOption(CLI::App& verb, std::string& profile) {
    verb.add_option("--profile", profile, "Size of pictures and length of timelines")
        ->type_name("TEXT:{gate,standard,paper}")
        ->capture_default_str();
}

void addSeedOption(CLI::App& verb, std::uint32_t& seed) {
    verb.add_option("--seed", seed, "Seed of pseudo-random choices")->check(CLI::Range(1U, 100000U))->capture_default_str();
}

} // namespace shadowbench
