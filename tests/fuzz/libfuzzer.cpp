// The fuzzer: libFuzzer's entry points, for the target that $SHADOWBENCH_FUZZ names. tools/fuzz starts it; without that
// variable it prints the targets.
#include "tests/fuzz/target.h"
#include "tests/fuzz/tokens.h"
#include "tests/fuzz/worker.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// libFuzzer keeps inputs that set one of these which no other did: what readers said in workers, whose coverage it does not
/// see.
__attribute__((section("__libfuzzer_extra_counters"))) static std::array<std::uint8_t, 1024> said;

namespace shadowbench::fuzz {
namespace {

/// What became of all inputs; said at the end, when it is counted (tools/fuzz).
struct Counts {
    std::size_t taken = 0, refused = 0;
    ~Counts() {
        const WorkerCounts& workers = workerCounts();
        if (taken + refused > 0)
            fmt::print(stderr, "readers: {} taken, {} refused, {} died, {} stopped, {} workers\n", taken,
                       refused - workers.died - workers.stopped, workers.died, workers.stopped, workers.workers);
    }
};

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
    onReached([](std::size_t number) { said.at(number % said.size()) = 1; });
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Counts counts;
    ++(isTaken([&] { chosen().read(textOf(data, size)); }) ? counts.taken : counts.refused);
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
