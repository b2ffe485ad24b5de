#include "gate/waivers.h"

#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>

namespace shadowbench::gate {

std::string today() { return fmt::format("{:%F}", fmt::gmtime(std::time(nullptr))); }

std::vector<std::string> waive(std::vector<Change>& changes, const std::vector<Waiver>& waivers, const std::string& today) {
    std::vector<std::string> notes;
    for (const Waiver& waiver : waivers) {
        const std::string entry = fmt::format("the waiver \"{}\"", waiver.reason);
        if (waiver.expires < today) {
            notes.push_back(fmt::format("{} held until {} and accepts nothing now", entry, waiver.expires));
            continue;
        }
        bool accepts = false;
        for (Change& change : changes) {
            if (change.direction != Direction::Worse && change.direction != Direction::NotCompared) continue;
            if (waiver.what != name(change.changeClass) || !waiver.covers(change.scene, change.variant)) continue;
            change.direction = Direction::Waived;
            change.sentence += fmt::format(" (accepted until {}: {})", waiver.expires, waiver.reason);
            accepts = true;
        }
        if (!accepts) notes.push_back(entry + " accepts nothing: remove it");
    }
    return notes;
}

} // namespace shadowbench::gate
