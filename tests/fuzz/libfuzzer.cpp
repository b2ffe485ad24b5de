// The fuzzer: libFuzzer's entry points, for the target that $SHADOWBENCH_FUZZ names. tools/fuzz starts it; without that
// variable it prints the targets.
#include "tests/fuzz/target.h"
#include "tests/fuzz/tokens.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace shadowbench::fuzz {
namespace {

/// A line each: name, longest input, dictionary and seeds.
[[noreturn]] void listTargets() {
    for (const Target& target : targets())
        fmt::print("{} {} {} {}\n", target.name, target.longest, target.dictionary, target.seeds);
    std::exit(0);
}

const Target& chosen() {
    static const Target& target = targetNamed(std::getenv("SHADOWBENCH_FUZZ"));
    return target;
}

std::string_view textOf(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

} // namespace
} // namespace shadowbench::fuzz

using namespace shadowbench::fuzz;

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    if (std::getenv("SHADOWBENCH_FUZZ") == nullptr) listTargets();
    chosen();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    isTaken([&] { chosen().read(textOf(data, size)); });
    return 0;
}

/// Every other change of a text is one of its tokens.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    if (chosen().kind == Kind::Bytes || seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
    const std::string text = changed(textOf(data, size), seed);
    const std::size_t length = std::min(text.size(), most);
    std::memcpy(data, text.data(), length);
    return length;
}
