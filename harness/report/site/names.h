// Names of records as file names and addresses.
#pragma once

#include "harness/records/record.h"

#include <string>

namespace shadowbench::site {

/// A name that is safe in a file name and in an address, the same for the same name and another for another:
/// "pcss:taps=32+32" → "pcss_taps=32+32". Letters, digits and .=+-_, stay; if others go, it is long, or it begins with a dot,
/// a hash of the name follows.
std::string slug(const std::string& name);

/// From the site's folder: "scenes/simple.html".
std::string sceneAddress(const std::string& scene);

/// From the site's folder: "cells/simple.html#pcss_taps=32+32".
std::string cellAddress(const Record& record);

/// A name as people see it: the first 160 characters of a longer one, then how many there are.
std::string shown(const std::string& name);

} // namespace shadowbench::site
