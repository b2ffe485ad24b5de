// Where series change, and which commits may have done it.
#pragma once

#include "history/change_points.h"
#include "history/repository.h"
#include "history/series.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::history {

/// A stretch of a series on one level.
struct Level {
    std::size_t first, last; // indices in the history's commits
    double value;            // the first figure; of noisy ones the median
    std::size_t figures;
};

struct Levels {
    /// Of each series in order: one where nothing changes. Figures without noise by the gate's allowance, others by the
    /// rule, where a change of the median by no more than the gate's floor of times is none.
    std::vector<std::vector<Level>> levels;
    /// Of each noisy series, the smallest rise of its newest figures that would be found, as a share of its newest level;
    /// nothing where its newest level has too few.
    std::vector<std::optional<double>> smallest;
};

Levels levelsOf(const History& history, const NoiseRule& rule);

struct LevelChange {
    std::size_t series; // index in the history's
    Level before, after;
    gate::Direction direction;
    /// In [0, 1]: the share of the larger of the two levels that the change is, but a hundredth of the number of allowances
    /// if that is less. So the step from no to three wrong pixels is not a large one.
    double size;
};

/// All changes between the `levels` of the history's series, the largest first.
std::vector<LevelChange> changesBetween(const History& history, const std::vector<std::vector<Level>>& levels);

/// What else a reader must know of a metric of a cell.
struct Event {
    std::string what;   // that it began, vanished, is in error, or why it cannot be compared with what was before
    std::size_t series; // index in the history's
    std::size_t commit; // the first or, of what vanished, the last that has it; the newest in error
};

std::vector<Event> eventsOf(const History& history);

/// The commits after the last one known to be on the old level to the first one known to be on the new.
struct Suspects {
    std::size_t old, now;             // indices in the history's commits
    std::size_t commits = 0;          // that may have made the change, `now` among them; 0: the repository does not know
    std::string middle;               // the one that halves them; "" if there is but one
    std::vector<std::size_t> changes; // indices in the list of changes, the largest first
};

/// A set of suspects for each pair of commits between which something changes, the largest change first.
std::vector<Suspects> suspectsOf(const History& history, const std::vector<LevelChange>& changes,
                                 const std::optional<Repository>& repository);

} // namespace shadowbench::history
