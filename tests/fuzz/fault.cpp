#include "tests/fuzz/fault.h"

#include <algorithm>
#include <array>
#include <regex>
#include <vector>

// NOLINTBEGIN(bugprone-reserved-identifier): their own names
extern "C" void __sanitizer_symbolize_pc(void* pc, const char* format, char* text, std::size_t size) __attribute__((weak));
// NOLINTEND(bugprone-reserved-identifier)

namespace shadowbench::fuzz {
namespace {

struct Frame {
    int number;
    std::uintptr_t address;
    std::string module; // path
};

/// "    #1 0x55d0c8 in name (/path/of/module+0x12c8)", with or without the name.
std::vector<Frame> firstStackOf(std::string_view report) {
    static const std::regex line(R"( *#(\d+) 0x([0-9a-f]+) .*\(([^()]+)\+0x[0-9a-f]+\).*)");
    std::vector<Frame> frames;
    while (!report.empty()) {
        const std::size_t end = std::min(report.find('\n'), report.size());
        std::smatch parts;
        const std::string text(report.substr(0, end));
        report.remove_prefix(std::min(end + 1, report.size()));
        if (!std::regex_match(text, parts, line)) continue;
        const Frame frame{std::stoi(parts[1]), std::stoull(parts[2], nullptr, 16), parts[3]};
        if (frame.number != static_cast<int>(frames.size())) break; // another stack begins
        frames.push_back(frame);
    }
    return frames;
}

/// Of the C and C++ libraries: they do what they are told.
bool isOfTheSystem(std::string_view library) {
    constexpr auto system = std::to_array<std::string_view>(
        {"libc.", "libm.", "libstdc++.", "libgcc_s.", "ld-linux", "libasan.", "libtsan.", "libubsan."});
    return std::ranges::any_of(system, [&](std::string_view name) { return library.starts_with(name); });
}

/// The sanitizers' functions have no source file here, an object file, or one of compiler-rt. Templates of the C++ library
/// that this program has, too, are run by libraries in its stead.
bool isOurs(const std::string& symbol) {
    if (symbol.find("/compiler-rt/") != std::string::npos || symbol.find("/include/c++/") != std::string::npos) return false;
    return symbol.find(" /") != std::string::npos || symbol.find("shadowbench::") != std::string::npos;
}

} // namespace

std::string symbolAt(std::uintptr_t address) {
    std::array<char, 1000> text{};
    if (__sanitizer_symbolize_pc != nullptr)
        __sanitizer_symbolize_pc(reinterpret_cast<void*>(address), "%f %s", text.data(), text.size());
    return text.data();
}

std::string libraryAtFault(std::string_view report, std::string_view program, const SymbolAt& symbol) {
    // Where std::bad_alloc would be thrown, which the reader of a run refuses the file for, the sanitizer cannot throw it.
    if (report.find("ERROR: AddressSanitizer: allocator is out of memory") != std::string_view::npos) return "memory";
    for (const Frame& frame : firstStackOf(report)) {
        if (frame.module == program) {
            if (isOurs(symbol(frame.address))) return "";
            continue;
        }
        const std::string library = frame.module.substr(frame.module.rfind('/') + 1);
        if (!isOfTheSystem(library)) return library;
    }
    return "";
}

} // namespace shadowbench::fuzz
