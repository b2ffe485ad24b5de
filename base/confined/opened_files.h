// Files of other people, opened by us for a child that can open none.
#pragma once

#include "base/descriptor.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace shadowbench {

/// A regular file, for reading.
struct OpenedFile {
    std::string name; // by which the reader asks for it
    std::uint64_t size = 0;
    Descriptor descriptor;
};

/// Opens `file`, whose name for the reader is that without its folder. Throws BadInput naming it after `doing`: not there, a
/// folder, a pipe or device, or larger than Limit::FileMib.
OpenedFile openRegular(const std::filesystem::path& file, const std::string& doing = "cannot read");

/// Opens the file that another one in `folder` names, a relative path with '/'. Throws BadInput as above, and where the path
/// is absolute, has a `..`, or leads through a symbolic link: what a foreign file names stays below its folder.
OpenedFile openBelow(const std::filesystem::path& folder, const std::string& name);

/// All bytes of an opened file. Throws BadInput naming it when they cannot be read, or are fewer or more than `size`.
std::string contentOf(const OpenedFile& file);

} // namespace shadowbench
