#include "base/error.h"
#include "harness/measure/callgrind.h"

#include <gtest/gtest.h>

namespace shadowbench::timing {
namespace {

constexpr std::string_view dump = R"(# callgrind format
version: 1
creator: callgrind-3.19.0
pid: 4711
cmd:  shadowbench count-frames --scene simple
part: 2


desc: I1 cache: 
desc: Timerange: Basic block 0 - 1276
desc: Trigger: Client Request: pcss:taps=32+32

positions: line
events: Ir
summary: 310442871

fn=(12)
0 17

totals: 310442871
)";

TEST(Callgrind, ADumpGivesItsTriggerAndItsTotal) {
    const CallgrindDump parsed = parseCallgrindDump(dump);
    EXPECT_EQ(parsed.trigger, "pcss:taps=32+32");
    EXPECT_EQ(parsed.instructions, 310442871U);
}

TEST(Callgrind, AnythingElseIsRefused) {
    EXPECT_THROW(parseCallgrindDump(""), BadInput);
    EXPECT_THROW(parseCallgrindDump("desc: Trigger: Program termination\n\ntotals: 12\n"), BadInput);
    EXPECT_THROW(parseCallgrindDump("desc: Trigger: Client Request: none\nsummary: 12\n"), BadInput);
}

} // namespace
} // namespace shadowbench::timing
