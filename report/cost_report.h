// Costs pass by pass, and what decides them beside the technique.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// What rasteriser drew the timed records of `scene`, with how many threads, and what that does to their times: a sentence
/// for the foot of a table of costs. "" where none was timed.
std::string rasteriserNote(const std::vector<Record>& records, const std::string& scene);

/// A frame of a record whose passes have times.
struct TimedFrame {
    int width, height;
    const std::vector<PassRecord>* passes;
};

/// The scored image and one of another size (Record::otherScreen); where a graphics processor drew, the larger images on
/// which its frames were timed (Record::deviceCosts). Empty where nothing was timed.
std::vector<TimedFrame> timedFrames(const Record& record);

/// Markdown: whole frames on a graphics processor, on each image that they were timed on; the base is sm-uniform, of levels
/// of detail lod-switch. "" where none drew.
std::string deviceTable(const std::vector<Record>& records, const std::string& scene);

/// Markdown: the passes of every timed record of `scene` with their times, work and what they grow with; below them the
/// changed ones of the frame in motion and of the first frame. "" where no record has passes with times.
std::string passTable(const std::vector<Record>& records, const std::string& scene);

/// Those of `passes`, of a frame in motion or the first one, that the standing frame lacks or runs and draws otherwise.
/// Fragments alone do not count: a map that is turned from frame to frame covers a few more or less.
std::vector<PassRecord> changedPasses(const std::vector<PassRecord>& passes, const std::vector<PassRecord>& standing);

/// One row a pass of a record, what is absent empty; passes of the frame in motion and of the first one, and on an image of
/// another size (Record::otherScreen), have rows of their own. "" without passes.
std::string passCsv(const std::vector<Record>& records);

/// Frame times, a bar a record, stacked by pass, as SVG; nothing where no record has passes with times.
std::optional<std::string> passChart(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::report
