// Names of records as file names and addresses.
#pragma once

#include "harness/records/record.h"
#include "report/slug.h"

#include <string>

namespace shadowbench::site {

using report::slug;

/// From the site's folder: "scenes/simple.html".
std::string sceneAddress(const std::string& scene);

/// From the site's folder: "cells/simple.html#pcss_taps=32+32".
std::string cellAddress(const Record& record);

inline constexpr std::size_t nameRoom = 160, sentenceRoom = 4000; // bytes

/// Text as people see it: the first `most` bytes of a longer one, then how many there are. By default for names; sentences
/// have more room.
std::string truncate(const std::string& text, std::size_t most = nameRoom);

} // namespace shadowbench::site
