#include "harness/gate/anchor.h"

#include <fmt/format.h>
#include <map>

namespace shadowbench::gate {
namespace {

/// The part of a sentence that says why: cells of one reason are noted together.
std::string reasonOf(const Change& change) {
    const std::size_t colon = change.sentence.rfind(": ");
    return colon == std::string::npos ? change.sentence : change.sentence.substr(colon + 2);
}

} // namespace

AnchorJudgement judgeDrift(const Anchor& anchor, const std::vector<Record>& before, const std::vector<Record>& now) {
    AnchorJudgement judgement;
    std::map<std::string, std::size_t> unjudged;
    for (Change& change : compare(before, now)) {
        if (change.direction == Direction::Unjudged) ++unjudged[reasonOf(change)];
        const bool isNumber = change.base && change.head && change.changeClass != Class::BreakPoint;
        if (change.direction == Direction::Unjudged || !isNumber) continue;
        ++judgement.compared;
        change.allowance *= anchor.limit;
        if (change.changeClass == Class::Figure || *change.head <= *change.base + change.allowance) continue;
        change.direction = Direction::Worse;
        change.sentence += fmt::format(", since the anchor {}", anchor.commit);
        judgement.changes.push_back(std::move(change));
    }
    for (const auto& [reason, count] : unjudged)
        judgement.notes.push_back(
            fmt::format("{} comparisons with the anchor {} were not made: {}", count, anchor.commit, reason));
    return judgement;
}

} // namespace shadowbench::gate
