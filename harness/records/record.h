// The record of one cell (scene × technique variant × profile): the only thing that reports and gates read.
// Written as one JSON object a line in results.jsonl; record.schema.json beside this file describes it to machines.
// A metric that does not apply is absent, never 0. Rates are fractions, times milliseconds, sizes bytes.
#pragma once

#include "harness/metrics/scores.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench {

enum class Status { Scored, NotApplicable, ExpectedFailure, Error };

struct Stability {
    std::optional<Flicker> flicker;          // over the moving frames
    std::optional<double> flipRate;          // over the moving frames
    std::optional<double> movingRmse;        // of V − V* over the moving frames: what flicker does not see, a steady trail
    std::optional<double> disocclusionError; // the same over the pixels in their first frame
    std::optional<double> reuse;             // share of the moving frames' surface pixels that the frame before saw, too
    std::optional<int> convergence;          // still frames needed from an empty history
    std::vector<double> mismatchByFrame;     // over the still frames from an empty history; techniques with history only
    std::vector<double> rmseByFrame;
    std::vector<double> bad30ByFrame;
    std::vector<double> changedByFrame; // share of M differing by > 30/255 from the technique's own last still frame (EGSR
                                        // paper, Fig. 3: "differing from the fully converged solution")
};

struct Time {
    double median = 0, p95 = 0, mad = 0; // ms a frame, G-buffer included
    double ratio = 1;                    // to sm-uniform in the same interleaved rounds, both with the G-buffer
    double floorRatio = 0;               // share of the frame that the G-buffer alone takes
    std::optional<double> baseRatio;     // to the technique's own base (history over its base map)
    std::vector<double> samples;
};

struct Work {
    std::uint64_t fragments = 0, vertices = 0, primitives = 0, draws = 0, passes = 0, bytes = 0;
};

struct Cost {
    std::optional<Time> time;
    std::optional<Work> work;
    std::optional<std::uint64_t> instructions;
};

/// Frames of a level-of-detail technique over the scene's walk, each timed beside lod-switch's, without the G-buffer; of a
/// rasteriser that draws on the calling thread its processor time, which other programs do not disturb.
struct LodTime {
    double median = 0; // ms a frame
    double ratio = 1;  // to lod-switch: median over the frames
    double spread = 0; // median change from one frame to the next, as a share of the former
};

/// Scores of a level-of-detail technique over the scene's walk (docs/metrics.md, "Levels of detail"; Scherzer and Wimmer
/// 2008, 5.2). Colours are in [0, 1]; changes are from one frame to the next.
struct Lod {
    // While camera and instances stand and levels alone change, so that lod-full's picture stays as it is:
    double pop = 0;                  // largest mean change of colour
    std::uint64_t changedRegion = 0; // pixels of the largest connected region that changes by > 30/255
    // Along the walk:
    double walkPop = 0;          // largest mean change of colour beyond lod-full's; coarse levels alias less and change less
    double colourError = 0;      // rms difference from lod-full
    std::optional<double> noise; // mean distance from the 3 × 3 median beyond lod-full's, where pixels see a transition
    double orderError = 0;       // rms difference from the same with all triangles drawn the other way round
    std::uint64_t transitions = 0; // most instances in transition at once
    double primitives = 0;         // a frame, mean
    double primitiveChange = 0;    // largest, as a share of the former frame's
    std::optional<LodTime> time;
    std::vector<double> popByFrame, walkPopByFrame; // from frame 1
    std::vector<double> primitivesByFrame, millisecondsByFrame;
};

struct Environment {
    std::string renderer, gl, cpu, compiler;
    int rasterThreads = 0;
    int vectorBits = 0;
    std::optional<std::string> valgrind;
};

struct ReferenceInfo {
    std::string oracle, key;
    int samples = 0;
    double sigma = 0; // rms over penumbra pixels; 0 for exact
    std::map<std::string, std::string> tools;
};

/// The place of a record on a curve over one quantity (`sweep`). All records of a curve have the same scene, axis and curve.
struct SweepStep {
    std::string axis, unit;           // "near-plane", "m"
    std::string curve;                // the variant, without the axis if that is a parameter
    double value = 0;                 // of the axis, here
    std::optional<double> breakPoint; // first value of the whole curve at which the scene's tolerance is exceeded
};

struct Record {
    int schemaVersion = 1;
    std::string scene, technique, variant;
    std::vector<std::pair<std::string, std::string>>
        parameters; // every parameter in declared order, as written in a variant
    std::string profile;
    int width = 0, height = 0, frames = 0;
    std::uint32_t seed = 1;
    Status status = Status::Scored;
    std::string reason; // of NotApplicable, ExpectedFailure and Error
    std::string cell;   // hash of the cell's inputs: two records with one cell id measured the same thing
    std::string commit;
    bool dirty = false;
    std::string time; // ISO 8601, UTC
    Environment environment;
    std::optional<ReferenceInfo> reference;
    std::optional<ReferenceInfo> softReference; // the second truth of a hard technique on an area-light scene
    std::optional<SweepStep> sweep;             // of `sweep` only
    std::optional<Lod> lod;                     // of level-of-detail techniques, which have no accuracy or stability
    Accuracy accuracy;
    std::optional<Aliasing> aliasing;      // of techniques with a map
    std::map<std::string, double> figures; // of the scored frame, by names that `list techniques` explains
    Stability stability;
    Cost cost;
    double tolerance = 0;        // the scene's, for the metric below; 0 if it states none
    std::string toleranceMetric; // "mismatch", "penumbra_rmse" …
};

/// One JSON line, keys in schema order, no newline. Numbers are written so that they read back equal; a parameter that is a
/// number is written as one and reads back in its shortest form. `accuracy` is written for scored records and expected
/// failures without `lod` only, other groups when something is in them. Throws InternalError naming the key of a number that
/// is not finite.
std::string toJson(const Record& record);

/// Throws BadInput naming the key when `json` is not a record of this schema version: a key is missing, unknown or of
/// another type.
Record parseRecord(const std::string& json);

/// All records of a results.jsonl; throws BadInput naming file and line. A last line without newline (a killed writer of
/// another program) is an error too: this program never leaves one.
std::vector<Record> readRecords(const std::filesystem::path& file);

/// Replaces the file, whole or not at all.
void writeRecords(const std::filesystem::path& file, const std::vector<Record>& records);

std::string_view name(Status status);

/// The metric that ranks a record's accuracy, the same for all records of one scene: "rmse" where a soft truth (oracle
/// "povray") was used, for a hard technique beside its exact one, else "mismatch"; nothing if it was not scored.
struct Headline {
    std::string metric;
    double value;
};
std::optional<Headline> headline(const Record& record);

/// A metric of `accuracy` by its name in the record ("mismatch_off_edge"); nothing if it is absent or there is none of that
/// name.
std::optional<double> accuracyMetric(const Accuracy& accuracy, std::string_view metric);

/// A metric that a scene or the gate may put a bound on, by its name there: those of `accuracy`, and "edge_error",
/// "flicker", "flip_rate", "moving_rmse", "disocclusion_error", "convergence", "pop". Nothing where the record lacks it.
std::optional<double> boundedMetric(const Record& record, std::string_view metric);

} // namespace shadowbench
