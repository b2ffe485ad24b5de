// The readers of what others wrote, as the fuzzers (tools/fuzz) and the test that replays their inputs call them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace shadowbench::fuzz {

/// How inputs are changed.
enum class Kind {
    Text,  // token by token as well as byte by byte (tests/fuzz/tokens.h)
    Bytes, // byte by byte
};

struct Target {
    std::string_view name; // of its folder below tests/fuzz/corpus
    Kind kind;
    std::size_t longest;         // input that is tried, in bytes
    std::string_view dictionary; // its name, of a .dict beside this file
    std::string_view seeds;      // what to begin with beside the corpus: a glob of the tree, or ""
    void (*read)(std::string_view input);
};

std::span<const Target> targets();
const Target& targetNamed(std::string_view name); // throws BadInput naming all

/// Whether `read` takes its input; false if it refuses it as it should: by BadInput or Inconclusive, with a sentence. Every
/// other exception passes through.
bool isTaken(const std::function<void()>& read);

/// Of a reader's own target: throws std::logic_error unless `holds`.
void require(bool holds, const std::string& sentence);

/// A folder of this process for the files that readers are given by name.
const std::filesystem::path& folder();

/// Replaces the file `name` in that folder, and returns its path.
std::filesystem::path kept(const std::string& name, std::string_view content);

} // namespace shadowbench::fuzz
