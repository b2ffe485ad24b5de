#include "report/doubts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::report {
namespace {

bool expects(const Record& record, std::string_view bound) {
    return record.status == Status::ExpectedFailure && record.reason.find(bound) != std::string::npos;
}

} // namespace

std::vector<Doubt> doubts(const Record& record) {
    std::vector<Doubt> found;
    if (!wasScored(record.status)) return found;
    const auto& none = record.values["sanity.times_none"];
    if (none && *none > worstTimesNone)
        found.push_back(
            {fmt::format("worse than no shadow: {:.3g} times its error", *none), record.status == Status::ExpectedFailure});
    const auto& map = record.values["sanity.map_step"];
    if (map && *map > worstStep)
        found.push_back({fmt::format("a map a fortieth larger changes the error by a factor of {:.3g}", *map),
                         expects(record, "map_step")});
    const auto& image = record.values["sanity.image_step"];
    if (image && *image > worstStep)
        found.push_back({fmt::format("an image a fortieth larger changes the error by a factor of {:.3g}", *image),
                         expects(record, "image_step")});
    return found;
}

std::string unexplainedDoubts(const Record& record) {
    std::vector<std::string> texts;
    for (const Doubt& doubt : doubts(record))
        if (!doubt.explained) texts.push_back(doubt.says);
    return fmt::format("{}", fmt::join(texts, "; "));
}

} // namespace shadowbench::report
