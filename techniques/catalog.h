// The catalogue: every technique by its id, and variants by their names.
#pragma once

#include "techniques/contract/entry.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// Every technique, in the order tables print them: those that are built in, then those of folders.
std::span<const Entry> catalog();

/// Adds a technique folder (docs/technique-folders.md) to the catalogue of this process and of those that it starts. Before
/// the first use of the catalogue, which reads the folders and throws BadInput for what is wrong in one.
void addTechniqueFolder(const std::filesystem::path& folder);

/// What the added folders declare and nothing uses, a line each with file, line and name. Throws BadInput as the catalogue
/// does.
std::vector<std::string> unusedInFolders();

/// The variables that a child process needs to draw as this one does.
std::vector<std::string> inheritedVariables();

/// The entry of `id`; throws BadInput with near matches.
const Entry& entryNamed(std::string_view id);

/// "pcss:taps=32+32" → variant; throws BadInput naming what is valid.
Variant parseVariant(std::string_view text);

/// Variants matching a pattern: one variant string, or a glob over ids ("sm-*", "*") that gives each match's
/// Entry::variants.
std::vector<Variant> matchVariants(const std::string& pattern);

/// The variant that `variant` is compared in cost with (Entry::costBase), if there is one.
std::optional<Variant> costBase(const Variant& variant);

} // namespace shadowbench::techniques
