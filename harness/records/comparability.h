// Whether two records may be compared: what besides the program decides a figure must be the same.
#pragma once

#include "harness/records/record.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// What decides scores, what also decides instruction counts, and all of it. Members that one of two environments does not
/// state, as older records do not, are no difference.
enum class EnvironmentScope { OfScores, OfCounts, All };

/// The first member in which two environments differ, in words: `cpu is "x" and "y"`; nothing if they are the same.
std::optional<std::string> difference(const Environment& a, const Environment& b, EnvironmentScope what);

/// What an instruction count depends on beside the program.
std::string countingEnvironment(const Environment& environment);

/// The truth that a metric was computed from, of up to three that a record has; `reference` for what no truth decides, too.
const std::optional<ReferenceInfo>& truthOf(const metrics::Metric& metric, const Record& record);

/// Why the figures of two records of one cell cannot be compared, as the end of a sentence: another truth of what the
/// technique answers (the scene or the ground truth changed), parameters that both have with other values, another number of
/// frames, another rasteriser. Nothing where they can.
std::optional<std::string> whyIncomparable(const Record& base, const Record& head);

/// Why one metric of two records that can be compared cannot: the truth that it was computed from is another one, of a
/// metric of moving frames that of any of them, or the class of pixels that it is over has another size.
std::optional<std::string> whyIncomparable(const metrics::Metric& metric, const Record& base, const Record& head);

/// The records of the files, one after the other. Throws BadInput naming two that state costs (times, instruction counts)
/// which different devices took: tables, charts and verdicts would put them side by side. Times that another renderer
/// reports of itself (techniques "external:…") are its own.
std::vector<Record> readOfOneDevice(const std::vector<std::filesystem::path>& files);

/// Whether both were scored by the same code, as far as they say.
bool sameMetricCode(const Record& base, const Record& head);

/// Whether both are known to show the same, to the bit, in all frames that were scored.
bool sameImages(const Record& base, const Record& head);

} // namespace shadowbench::gate
