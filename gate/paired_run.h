// Frames of two programs in turns, and what the paired-time rule makes of them (docs/gate.md, "Time").
#pragma once

#include "base/progress.h"
#include "gate/paired.h"
#include "harness/measure/timed_frames.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// A shadow technique on a scene; techniques of levels of detail have no paired time.
struct TimedCell {
    std::string scene; // id, or an absolute path
    std::string variant;
};

struct PairedOptions {
    Profile profile = Profile::Gate;
    TimeRule rule;
    int restarts = 4; // of all workers, for where a process lies in memory moves its speed; as many again while unclear
    int rounds = 20;  // a restart, one turn of each worker a round
    std::uint32_t seed = 1; // of the order of turns, and of the techniques' pseudo-random choices
};

/// One turn of each: the base, the head, and the base again as the control.
struct PairedRound {
    timing::FrameTime base, head, control; // of `framesPerTurn` frames
};

struct PairedSamples {
    int framesPerTurn = 1;
    std::vector<std::vector<PairedRound>> restarts; // rounds of each
};

/// Logarithms of the time of `who` over the base's, one a round.
std::vector<double> logRatios(const PairedSamples& samples, timing::FrameTime PairedRound::*who,
                              double timing::FrameTime::*clock = &timing::FrameTime::cpu);

/// What the three took in each restart. A round and the next, which has the reversed order, count as one.
std::vector<RestartTimes> restartTimes(const PairedSamples& samples,
                                       double timing::FrameTime::*clock = &timing::FrameTime::cpu);

struct TimeJudgement {
    TimedCell cell;
    TimeVerdict verdict = TimeVerdict::Unclear; // Unclear for good: slower by the estimate, but that is not certain enough
    double ratio = 1;                           // head's CPU time over that of base and control, estimated
    double lowerBound = 0;                      // one-sided, of `ratio`'s true value, where the head is slower
    int rounds = 0;                             // in all
    double smallestTold = 0;                    // least slowdown, as a share, that restarts like these would have told
    bool controlAlarm = false;                  // two equal programs were measured as different: inconclusive
    double wallRatio = 1;                       // the same as `ratio`, of wall time
    bool waits = false;                         // slower by wall time, for which equal programs show no difference
    PairedSamples samples;
};

/// Whether no more restarts are wanted of one of `cells` cells. Each time that `options.restarts` more are done, a cell
/// passes that is not slower by the estimate, of CPU time and of wall time; after 3, 6, 12 and 24 times as many it is slower
/// or waits if that is certain.
bool enough(const PairedSamples& samples, const PairedOptions& options, int cells);

/// The rule's judgement of a cell once its samples are enough. A head that sleeps or waits takes no CPU time for it: its
/// wall time is judged beside, by a floor of its own.
TimeJudgement judgeSamples(const TimedCell& cell, PairedSamples samples, const PairedOptions& options, int cells);

/// Whether each cell is slower with the program `head` than with `base`, in the order of `cells`. Each restart starts three
/// workers a scene on one core, base, head and base again as the control, in a random order, which take all cells of the
/// scene one after the other: warm up, then rounds of one turn each in an order that is drawn anew and then reversed. What
/// is judged is CPU time, in which another process on the core does not count. A turn is as many frames as take the base
/// some milliseconds, the same for all three. Takes 1 to 24 times `options.restarts` restarts a cell (see `enough`). Throws
/// what the workers throw; `progress` stays at 1 while unclear cells are measured on.
std::vector<TimeJudgement> judgePairedTime(const std::filesystem::path& base, const std::filesystem::path& head,
                                           const std::vector<TimedCell>& cells, const PairedOptions& options,
                                           const Progress& progress);

} // namespace shadowbench::gate
