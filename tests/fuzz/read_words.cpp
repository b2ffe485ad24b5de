#include "groundtruth/contract/reference.h"
#include "groundtruth/store/cache.h"
#include "groundtruth/store/cache_limits.h"
#include "harness/cells/truths.h"
#include "harness/foreign/foreign_row.h"
#include "harness/measure/callgrind.h"
#include "harness/runs/manifest.h"
#include "studies/sweep/axis.h"
#include "techniques/catalog.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

namespace shadowbench::fuzz {

void readWords(std::string_view input) {
    const std::string text(input);
    isTaken([&] {
        const std::string name = techniques::parseVariant(text).name;
        require(techniques::parseVariant(name).name == name, "a variant's name is another variant's: " + name);
    });
    isTaken([&] { techniques::matchVariants(text); });
    isTaken([&] {
        const shards::CellRange range = shards::shardRange(text, 100);
        require(range.first <= range.last && range.last <= 100, "a part of a run has cells that the run lacks");
    });
    isTaken([&] { groundtruth::bytesOf(text); });
    isTaken([&] { groundtruth::durationOf(text); });
    isTaken([&] { groundtruth::oracleNamed(text); });
    isTaken([&] { truthNamed(text); });
    isTaken([&] { profileNamed(text); });
    isTaken([&] { axisNamed(text); });
    isTaken([&] { foreign::definitionNamed(text); });
    isTaken([&] { timing::parseCallgrindDump(text); });
}

} // namespace shadowbench::fuzz
