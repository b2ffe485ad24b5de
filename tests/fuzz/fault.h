// Whose code a process died in, by what the sanitizers wrote about it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace shadowbench::fuzz {

/// What is at an address of this program's own code: function and source file, as "%f %s"; the file is empty for what was
/// compiled without debug information.
using SymbolAt = std::function<std::string(std::uintptr_t address)>;

/// By the sanitizers' own symbolizer; of a copy of this process the addresses are the same.
std::string symbolAt(std::uintptr_t address);

/// The file name of the library that the fault lies in: of the innermost function of the report's first stack that is
/// neither the sanitizers' nor of the C and C++ libraries. "" where that function is ours, and where there is no stack;
/// "memory" where an allocation failed. `program`: the path of this program, as reports have it.
std::string libraryAtFault(std::string_view report, std::string_view program, const SymbolAt& symbol);

} // namespace shadowbench::fuzz
