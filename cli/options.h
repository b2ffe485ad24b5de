// Options that several verbs have.
#pragma once

#include "harness/records/record.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace shadowbench {

/// `profile` is a name, for profileNamed().
void addProfileOption(CLI::App& verb, std::string& profile);

/// What draws: it is chosen for this process and for those that it starts.
void addGlOption(CLI::App& verb);

/// Folders that are techniques; their rows are what runs if no other is asked for. To be called after the option that fills
/// `techniques`.
void addTechniqueFolderOption(CLI::App& verb, std::vector<std::string>& techniques);

/// The same of a verb that names them all.
void addTechniqueFolderOption(CLI::App& verb);

/// Prints what these folders declare and nothing uses.
void warnOfFolders();

/// `standing` is set where light and casters stand still.
void addStaticOption(CLI::App& verb, bool& standing);

void addSeedOption(CLI::App& verb, std::uint32_t& seed);

/// Of a record file, or of the folder that a run wrote it to.
std::vector<Record> recordsAt(const std::filesystem::path& place);

} // namespace shadowbench
