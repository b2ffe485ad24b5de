// The record of one cell (scene × technique variant × profile): the only thing that reports and gates read.
// Written as one JSON object a line in results.jsonl; `recordSchema` describes it to machines. A metric that does not apply
// is absent, never 0. Rates are fractions, times milliseconds, sizes bytes.
#pragma once

#include "harness/metrics/values.h"

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

struct Environment {
    std::string renderer, gl, cpu, compiler;
    int rasterThreads = 0;
    int vectorBits = 0;
    std::optional<std::string> valgrind;
    // Empty in records that are older than these.
    std::string cpuFeatures = {}; // family, model, stepping and a hash of what it can do: names are often generic
    std::string mesa = {};        // the packages of rasteriser and its compiler, with their revisions
    std::string libraries = {};   // C and C++, with their revisions
    std::string platform = {};    // what gave the program its OpenGL: "osmesa" (as in older records) or "egl"
    std::string vendor = {};      // of the rasteriser: "Mesa/X.org", "NVIDIA Corporation"
    std::string driver = {};      // "Mesa 22.3.6", "NVIDIA 550.54.15"
};

/// The exact visible fraction at every pixel, beside the sampled truth of an area light.
struct AreaInfo {
    std::string key, content;
    double rms = 0;  // of the sampled truth against it, over the penumbra
    double rmse = 0; // of the cell against it, over the scored pixels, as "accuracy.rmse" is against the sampled truth
};

struct ReferenceInfo {
    std::string oracle, key;
    int samples = 0;
    double sigma = 0; // rms over penumbra pixels; 0 for exact
    std::map<std::string, std::string> tools;
    std::string content = {};          // hash of the pixels, whatever they were made by; "" in records of older programs
    std::optional<AreaInfo> area = {}; // of a sampled truth of an area light, where the exact one was computed beside it
};

/// The place of a record on a curve over one quantity (`sweep`). All records of a curve have the same scene, axis and curve.
struct SweepStep {
    std::string axis, unit;           // "near-plane", "m"
    std::string curve;                // the variant, without the axis if that is a parameter
    double value = 0;                 // of the axis, here
    std::optional<double> breakPoint; // first value of the whole curve at which the scene's tolerance is exceeded
};

/// What the pass of a frame costs that techniques name so (techniques/contract/pass.h); all its runs together.
struct PassRecord {
    std::string name; // "G-buffer" for the harness' own, `betweenPasses` for what belongs to none
    int runs = 0;
    std::optional<double> milliseconds = {}; // where times are measured
    std::optional<double> share = {};        // of the frame's time that the pass takes
    std::uint64_t fragments = 0, vertices = 0, draws = 0;
    std::string drawnWith = {}; // hash of shaders and state, of a technique folder's own passes
};
inline constexpr std::string_view betweenPasses = "between passes";

/// The same on an image of another size.
struct OtherScreen {
    int width = 0, height = 0;
    std::vector<PassRecord> passes;
};

/// Of a frame on a graphics processor, by that one's own clock, with an image of this size (harness/measure/device_cost.h).
struct DeviceCost {
    int width = 0, height = 0;
    double median = 0, mad = 0;               // ms of the standing frame, G-buffer included
    double ratio = 1;                         // to sm-uniform, of levels of detail to lod-switch, in the same rounds
    double processor = 0;                     // ms of the program in passes that draw nothing
    std::optional<double> motion, first = {}; // ms of the frame in motion and of the first; none of levels of detail
    std::vector<PassRecord> passes;
};

/// Milliseconds that a pass takes on a card by the model of docs/gpu-cost.md, by what takes them.
struct PassTerms {
    std::string name; // as in PassRecord
    double arithmetic = 0, texture = 0, output = 0, geometry = 0, memory = 0, fixed = 0;
};

/// Of frames on one card and an image of one size, by the model: nothing was drawn there.
struct ModelledCost {
    double milliseconds = 0, least = 0, most = 0; // standing: as the card says, and if one of its rates is another
    bool waits = false;                           // for the program, in some pass: what that takes is in no number
    std::vector<PassTerms> passes;
    std::optional<double> motion = {}, cold = {}; // of the frame in motion and of the first, where they draw otherwise
    std::vector<PassTerms> motionPasses = {}, coldPasses = {};
};

/// What a renderer that is not ours says of its own cost: never compared with what is measured here.
struct ReportedCost {
    double milliseconds = 0; // of a frame
    std::string device = {}; // "" if it does not say
};

/// A renderer that is not ours, of which this program has the images alone.
struct ExternalInfo {
    std::string title, source; // "" where nobody says
    std::optional<ReportedCost> reported = {};
    std::string revision = {}; // of its sources, in the words of their own repository; "" where nobody knows
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
    std::string reason; // of NotApplicable, ExpectedFailure (which bound is exceeded, and why) and Error
    std::string cell;   // hash of the cell's inputs: two records with one cell id measured the same thing
    std::string commit;
    bool dirty = false;
    std::string program;    // hash of the sources and the compiler it was built from; empty in older records
    std::string metricCode; // of these, of what scores; empty in older records
    std::string images;     // hash of all frames that were scored; empty in older records and where none was
    std::string truths;     // hash of what these were scored against, keys and contents; empty likewise
    std::string time;       // ISO 8601, UTC
    Environment environment;
    std::optional<ReferenceInfo> reference;
    std::optional<ReferenceInfo> softReference;   // the second truth of a hard technique on an area-light scene
    std::optional<ReferenceInfo> pixelReference;  // the truth of pixel areas that `flicker` and `pixel_area` are against
    std::optional<SweepStep> sweep;               // of `sweep` only
    metrics::Values values;                       // of every metric; a record has either "accuracy" or "lod"
    std::vector<PassRecord> passes;               // of the frame whose work was measured; empty in older records
    std::vector<PassRecord> motionPasses;         // of the frame in motion; empty where their work is that of `passes`
    std::vector<PassRecord> coldPasses;           // of the first frame, likewise
    std::optional<OtherScreen> otherScreen;       // where costs were measured on an image of another size, too
    std::vector<DeviceCost> deviceCosts;          // of larger images, where a graphics processor drew
    std::map<std::string, ModelledCost> modelled; // by card and size: "gtx-1080@1920x1080" (gpu-cost)
    std::map<std::string, double> figures;        // of the scored frame, by names that `list techniques` explains
    std::optional<ExternalInfo> external;         // of renderers that the program called
    std::map<std::string, double> tolerances;     // the scene's: the worst error that a viewer accepts, by names for bounds
};

/// One JSON line, keys in schema order, no newline. Numbers are written so that they read back equal; a parameter that is a
/// number is written as one and reads back in its shortest form. `accuracy` is written for scored records and expected
/// failures of shadows only, other groups when something is in them. Throws InternalError naming the key of a number that is
/// not finite, or of one that such a record must have.
std::string toJson(const Record& record);

/// The JSON Schema (draft 7) of a record, metrics as the table has them.
std::string recordSchema();

/// Throws BadInput naming the key when `json` is not a record of this schema version: a key is missing, unknown or of
/// another type. Older records, which state one tolerance only or have the times of bare passes, are read, too.
Record parseRecord(const std::string& json);

/// All records of a results.jsonl; throws BadInput naming file and line. A last line without newline (a killed writer of
/// another program) is an error too: this program never leaves one.
std::vector<Record> readRecords(const std::filesystem::path& file);

/// Replaces the file, whole or not at all.
void writeRecords(const std::filesystem::path& file, const std::vector<Record>& records);

std::string_view name(Status status);

/// Whether there are scores: also of a cell that fails as its scene expects.
bool wasScored(Status status);

/// The metric that ranks a record's accuracy, the same for all records of one scene: "rmse" where a soft truth (oracle
/// "povray") was used, for a hard technique beside its exact one, and where there are no labels, else "mismatch"; its mean
/// over views or seeds where several were drawn; nothing if it was not scored.
struct Headline {
    std::string metric;
    double value;
};
std::optional<Headline> headline(const Record& record);

/// Of a level-of-detail technique; such a record has no accuracy.
bool isLevelOfDetail(const Record& record);

/// What the names of other renderers' techniques begin with, and whether the record is of one.
inline constexpr std::string_view externalPrefix = "external:";
bool isExternal(const Record& record);

/// The commit whose figures these are: of another renderer's rows its own revision where that is known, else this program's
/// commit.
const std::string& revisionOf(const Record& record);

/// What the environment of such a record says instead of an OpenGL version.
inline constexpr std::string_view notDrawnHere = "none: not drawn here";

} // namespace shadowbench
