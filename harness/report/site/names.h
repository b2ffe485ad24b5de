// Names of records as file names and addresses.
#pragma once

#include "harness/records/record.h"
#include "harness/report/slug.h"

#include <string>

namespace shadowbench::site {

using report::slug;

/// From the site's folder: "scenes/simple.html".
std::string sceneAddress(const std::string& scene);

/// From the site's folder: "cells/simple.html#pcss_taps=32+32".
std::string cellAddress(const Record& record);

/// A name as people see it: the first 160 characters of a longer one, then how many there are.
std::string shown(const std::string& name);

} // namespace shadowbench::site
