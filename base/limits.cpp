#include "base/limits.h"

#include "base/error.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>

namespace shadowbench {
namespace {

constexpr std::uint64_t mostMib = 1 << 20;

constexpr std::array<LimitEntry, 11> all{{
    {Limit::FileMib, "SHADOWBENCH_MAX_FILE_MIB", 1024, mostMib, "MiB of one mesh, buffer or image file"},
    {Limit::TextMib, "SHADOWBENCH_MAX_TEXT_MIB", 1024, mostMib, "MiB of one scene, record or other file of text"},
    {Limit::Triangles, "SHADOWBENCH_MAX_TRIANGLES", 4'000'000, 1'000'000'000, "triangles of one mesh file"},
    {Limit::Vertices, "SHADOWBENCH_MAX_VERTICES", 12'000'000, 3'000'000'000,
     "vertices of one mesh file, before equal ones are joined"},
    {Limit::Pixels, "SHADOWBENCH_MAX_PIXELS", std::uint64_t{1} << 27, std::uint64_t{1} << 31, "pixels of one image"},
    {Limit::Instances, "SHADOWBENCH_MAX_INSTANCES", 100'000, 100'000'000, "instances of one object of a scene"},
    {Limit::Nesting, "SHADOWBENCH_MAX_NESTING", 64, 1000,
     "levels of lists and objects within each other in JSON, glTF's too"},
    {Limit::MemoryMib, "SHADOWBENCH_MAX_MEMORY_MIB", mostMib, mostMib,
     "MiB of memory that a scene may need; what the machine has where that is less"},
    {Limit::ReaderMib, "SHADOWBENCH_MAX_READER_MIB", 4096, mostMib, "MiB of memory to read one file in"},
    {Limit::ReaderSeconds, "SHADOWBENCH_MAX_READER_SECONDS", 4, 86'400,
     "seconds of processor time to read one file in, and one more for each of its MiB"},
    {Limit::CellSeconds, "SHADOWBENCH_MAX_CELL_SECONDS", 120, 86'400,
     "seconds to draw and score a technique folder's row on a scene of 256², larger ones in proportion"},
}};

const LimitEntry& entryOf(Limit limit) { return all.at(static_cast<std::size_t>(limit)); }

} // namespace

std::span<const LimitEntry> limits() { return all; }

std::string_view variableOf(Limit limit) { return entryOf(limit).variable; }

std::uint64_t limitOf(Limit limit) {
    const LimitEntry& entry = entryOf(limit);
    const char* set = std::getenv(std::string(entry.variable).c_str());
    if (set == nullptr) return entry.usual;
    const std::string_view text(set);
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > entry.most)
        throw BadInput(
            fmt::format("{}=\"{}\": expected a whole number from 1 to {}", entry.variable, text.substr(0, 40), entry.most));
    return number;
}

std::string beyond(Limit limit) {
    return fmt::format("more than the {} of {}, which can be raised", limitOf(limit), variableOf(limit));
}

} // namespace shadowbench
