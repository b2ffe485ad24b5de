#include "harness/records/presence.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <string_view>

namespace shadowbench::gate {
namespace {

/// Without the seed.
using SeedlessKey = std::tuple<std::string, std::string, std::string, int, int, std::string, std::string, double>;
SeedlessKey withoutSeed(const CellKey& key) {
    const auto& [scene, variant, profile, width, height, seed, axis, curve, value] = key;
    return {scene, variant, profile, width, height, axis, curve, value};
}

std::string nameOf(const std::string& scene, const std::string& variant) { return fmt::format("{} on {}", variant, scene); }

std::string withReason(const Record& record) {
    return fmt::format("{}{}{}", name(record.status), record.reason.empty() ? "" : ": ", record.reason);
}

class Matching {
public:
    Matching(const std::vector<Record>& base, const std::vector<Record>& head,
             const std::optional<std::vector<Expected>>& expected)
        : expected_(expected) {
        std::map<CellKey, const Record*> before = byCell(base, "the base");
        const std::map<CellKey, const Record*> now = byCell(head, "the head");
        for (const Record& record : head) {
            if (now.at(cellOf(record)) != &record) continue; // a repetition
            const auto found = before.find(cellOf(record));
            addPair(found == before.end() ? nullptr : found->second, record);
            if (found != before.end()) before.erase(found);
        }
        for (const Record& record : base)
            if (const auto found = before.find(cellOf(record)); found != before.end() && found->second == &record)
                addGone(record);
        addMissing(head);
    }

    Matched result;

private:
    std::map<CellKey, const Record*> byCell(const std::vector<Record>& records, std::string_view side) {
        std::map<CellKey, const Record*> cells;
        for (const Record& record : records)
            if (!cells.try_emplace(cellOf(record), &record).second)
                add(record, result.presence.repeated, fmt::format("cannot be compared: {} has it twice", side));
        return cells;
    }

    void addPair(const Record* before, const Record& now) {
        const bool scoredBefore = before != nullptr && wasScored(before->status), scoredNow = wasScored(now.status);
        const bool failedBefore = before != nullptr && before->status == Status::Error;
        if (!scoredNow && now.status != Status::Error && !scoredBefore && !failedBefore) return; // not applicable
        ++result.presence.expected;
        if (now.status == Status::Error || failedBefore) {
            const std::string failure = now.status == Status::Error ? withReason(now) : "error before: " + before->reason;
            add(now, result.presence.failed, "cannot be compared: it is " + failure);
        } else if (!scoredNow) {
            add(now, result.presence.gone, "cannot be compared: it was scored and is " + withReason(now));
        } else if (!scoredBefore && (before != nullptr || isNew(now))) {
            --result.presence.expected;
            add(now, result.presence.isNew, "is new", true);
        } else if (!scoredBefore) {
            add(now, result.presence.isNew, "cannot be compared: the base has no such result");
        } else {
            ++result.presence.compared;
            const auto [place, first] = places_.try_emplace(withoutSeed(cellOf(now)), result.cells.size());
            if (first) result.cells.emplace_back();
            result.cells[place->second].base.push_back(before);
            result.cells[place->second].head.push_back(&now);
        }
    }

    void addGone(const Record& record) {
        if (record.status == Status::NotApplicable) return;
        ++result.presence.expected;
        add(record, result.presence.gone, "is no longer measured");
    }

    /// Results that the head lacks, and so does the base.
    void addMissing(const std::vector<Record>& head) {
        if (!expected_) return;
        std::set<std::pair<std::string_view, std::string_view>> there;
        for (const Record& record : head)
            if (!record.sweep) there.emplace(record.scene, record.variant);
        for (const Absence& absence : result.absences) there.emplace(absence.scene, absence.variant);
        for (const Expected& expected : *expected_) {
            if (there.contains({expected.scene, expected.variant})) continue;
            ++result.presence.expected;
            result.presence.gone.push_back(nameOf(expected.scene, expected.variant));
            missing_.push_back({expected.scene, expected.variant, "was not measured"});
        }
        std::ranges::move(missing_, std::back_inserter(result.absences));
    }

    [[nodiscard]] bool isNew(const Record& record) const {
        const std::string& variant = record.sweep ? record.sweep->curve : record.variant;
        return expected_ && std::ranges::any_of(*expected_, [&](const Expected& e) {
                   return e.isNew && e.scene == record.scene && e.variant == variant;
               });
    }

    void add(const Record& record, std::vector<std::string>& list, const std::string& what, bool isNew = false) {
        list.push_back(nameOf(record.scene, record.variant));
        result.absences.push_back({record.scene, record.variant, what, isNew});
    }

    const std::optional<std::vector<Expected>>& expected_;
    std::map<SeedlessKey, std::size_t> places_;
    std::vector<Absence> missing_;
};

/// At most five different names, and how many more there are.
std::string listed(std::string_view what, std::vector<std::string> names) {
    constexpr std::size_t most = 5;
    const auto [first, last] = std::ranges::unique(names);
    names.erase(first, last);
    if (names.empty()) return "";
    const std::size_t more = names.size() - std::min(names.size(), most);
    names.resize(names.size() - more);
    return fmt::format("; {}: {}{}", what, fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

} // namespace

CellKey cellOf(const Record& r) {
    const SweepStep step = r.sweep.value_or(SweepStep{});
    return {r.scene, r.variant, r.profile, r.width, r.height, r.seed, step.axis, step.curve, step.value};
}

std::string text(const Presence& p) {
    return fmt::format("{} of {} expected results compared{}{}{}{}", p.compared, p.expected, listed("new", p.isNew),
                       listed("gone", p.gone), listed("failed", p.failed), listed("twice", p.repeated));
}

bool MatchedCell::is(bool (*predicate)(const Record&, const Record&)) const {
    return std::equal(base.begin(), base.end(), head.begin(),
                      [&](const Record* before, const Record* now) { return predicate(*before, *now); });
}

Matched match(const std::vector<Record>& base, const std::vector<Record>& head,
              const std::optional<std::vector<Expected>>& expected) {
    return std::move(Matching(base, head, expected).result);
}

} // namespace shadowbench::gate
