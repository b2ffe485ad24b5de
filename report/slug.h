// Names of records in file names and addresses.
#pragma once

#include <string>

namespace shadowbench::report {

/// A name that is safe in a file name and in an address, the same for the same name and another for another:
/// "pcss:taps=32+32" → "pcss_taps=32+32". Letters, digits and .=+-_, stay; if others go, it is long, or it begins with a
/// dot, a hash of the name follows.
std::string slug(const std::string& name);

} // namespace shadowbench::report
