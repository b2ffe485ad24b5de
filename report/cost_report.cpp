#include "report/cost_report.h"

#include "report/csv_text.h"
#include "report/summary.h"
#include "report/text_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <tuple>

namespace shadowbench::report {
namespace {

bool isTimed(const PassRecord& pass) { return pass.milliseconds.has_value(); }

std::vector<const Record*> timedRecords(const std::vector<Record>& records, const std::string& scene) {
    std::vector<const Record*> timed;
    for (const std::size_t i : ofScene(records, scene))
        if (!records[i].sweep && !timedFrames(records[i]).empty()) timed.push_back(&records[i]);
    return timed;
}

std::string sizeOf(int width, int height) {
    return width == height ? fmt::format("{}²", width) : fmt::format("{} × {}", width, height);
}

const PassRecord* passNamed(const std::vector<PassRecord>& passes, const std::string& name) {
    const auto found = std::ranges::find(passes, name, &PassRecord::name);
    return found == passes.end() ? nullptr : &*found;
}

/// What a pass' fragments grow with, from their numbers on two images: f₂/f₁ = (pixels₂/pixels₁)^e with e near 1 or near 0.
std::string growsWith(const PassRecord& pass, const TimedFrame& here, const TimedFrame& there) {
    if (pass.draws == 0 && pass.fragments == 0) return "–";
    const PassRecord* other = passNamed(*there.passes, pass.name);
    if (other == nullptr || other->fragments == 0 || pass.fragments == 0) return "–";
    const auto pixels = [](const TimedFrame& frame) { return static_cast<double>(frame.width) * frame.height; };
    const double exponent = std::log(static_cast<double>(other->fragments) / static_cast<double>(pass.fragments)) /
                            std::log(pixels(there) / pixels(here));
    return exponent > 0.75 ? "screen" : exponent < 0.25 ? "map" : "both";
}

std::string milliseconds(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : "–"; }

class PassRows {
public:
    explicit PassRows(const std::vector<const Record*>& records) {
        for (const Record* record : records)
            if (const auto frames = timedFrames(*record); frames.size() > 1) other_ = frames[1];
        table_.titles = {"technique", "pass", "runs", "ms", "share"};
        if (other_) table_.titles.push_back("ms at " + sizeOf(other_->width, other_->height));
        table_.titles.insert(table_.titles.end(), {"fragments", "vertices", "draws"});
        if (other_) table_.titles.emplace_back("grows with");
        for (const Record* record : records) addAll(*record);
    }

    [[nodiscard]] std::string text() const { return markdown(table_); }

private:
    void addAll(const Record& record) {
        const std::vector<TimedFrame> frames = timedFrames(record);
        const std::vector<PassRecord>& standing = *frames.front().passes;
        for (const PassRecord& pass : standing) add(frames, pass, &pass == &standing.front() ? record.variant : "", "");
        if (!record.deviceCosts.empty()) return; // of these frames only the whole is timed there
        for (const PassRecord& pass : changedPasses(record.motionPasses, standing)) add(frames, pass, "", ", in motion");
        for (const PassRecord& pass : changedPasses(record.coldPasses, standing)) add(frames, pass, "", ", first frame");
    }

    void add(const std::vector<TimedFrame>& frames, const PassRecord& pass, const std::string& variant, const char* frame) {
        std::vector<std::string> row{variant, pass.name + frame, std::to_string(pass.runs), milliseconds(pass.milliseconds),
                                     percent(pass.share.value_or(0))};
        const bool hasOther = frames.size() > 1;
        const PassRecord* other = hasOther ? passNamed(*frames[1].passes, pass.name) : nullptr;
        if (other_) row.push_back(milliseconds(other != nullptr ? other->milliseconds : std::nullopt));
        for (const std::uint64_t count : {pass.fragments, pass.vertices, pass.draws}) row.push_back(std::to_string(count));
        if (other_) row.push_back(hasOther ? growsWith(pass, frames[0], frames[1]) : "–");
        table_.rows.push_back(std::move(row));
    }

    std::optional<TimedFrame> other_; // of one of them; all of a scene have one size
    TextTable table_;
};

std::string cellOf(const std::optional<double>& value) { return value ? csvText(*value) : ""; }

std::string csvRow(const Record& record, int width, int height, const char* frame, const PassRecord& pass) {
    return csvLine({quoted(record.scene), quoted(record.variant), record.profile, csvText(width), csvText(height), frame,
                    quoted(pass.name), csvText(pass.runs), cellOf(pass.milliseconds), cellOf(pass.share),
                    csvText(pass.fragments), csvText(pass.vertices), csvText(pass.draws)});
}

/// " on images of 1024² and 2048² pixels, costs of the first".
std::string imagesOf(const Record& record) {
    std::string sizes;
    for (const DeviceCost& cost : record.deviceCosts)
        sizes += (sizes.empty() ? "" : " and ") + sizeOf(cost.width, cost.height);
    return sizes.empty() ? "" : fmt::format(", on images of {} pixels; costs are those of the first", sizes);
}

} // namespace

std::string rasteriserNote(const std::vector<Record>& records, const std::string& scene) {
    const auto timed = timedRecords(records, scene);
    if (timed.empty()) return "";
    const Environment& e = timed.front()->environment;
    if (e.vectorBits == 0) // a graphics processor
        return fmt::format("Times are of {}, {}, by its own clock{}.", e.renderer, e.driver, imagesOf(*timed.front()));
    const std::string threads =
        e.rasterThreads == 0 ? "on the calling thread alone" : fmt::format("with {} raster threads", e.rasterThreads);
    std::string text = fmt::format("Times are of {}, {}", e.renderer, threads);
    if (e.renderer.find("llvmpipe") == std::string::npos) return text + ".";
    return text +
           fmt::format(", a rasteriser in software: it shades {} pixels at a time and pays for both sides of every "
                       "`if` among them, each vertex is a call of compiled code, and a fragment costs what its texture "
                       "reads and arithmetic cost the processor, without units of their own for depth, blending and "
                       "filtering. A GPU hides much of that: compare fragments and vertices there.",
                       e.vectorBits / 32);
}

std::vector<TimedFrame> timedFrames(const Record& record) {
    std::vector<TimedFrame> frames;
    for (const DeviceCost& cost : record.deviceCosts) frames.push_back({cost.width, cost.height, &cost.passes});
    if (!frames.empty() || std::ranges::none_of(record.passes, isTimed)) return frames;
    frames.push_back({record.width, record.height, &record.passes});
    if (const auto& other = record.otherScreen) frames.push_back({other->width, other->height, &other->passes});
    return frames;
}

std::string deviceTable(const std::vector<Record>& records, const std::string& scene) {
    TextTable table;
    for (const Record* record : timedRecords(records, scene)) {
        if (record->deviceCosts.empty()) continue;
        table.titles = {"technique"};
        std::vector<std::string> row{record->variant};
        for (const DeviceCost& cost : record->deviceCosts) {
            const std::string size = sizeOf(cost.width, cost.height);
            for (const char* title : {"ms at ", "× base at ", "in motion at ", "first at ", "the program's at "})
                table.titles.push_back(title + size);
            row.insert(row.end(), {milliseconds(cost.median), fmt::format("{:.2f}", cost.ratio), milliseconds(cost.motion),
                                   milliseconds(cost.first), milliseconds(cost.processor)});
        }
        table.rows.push_back(std::move(row));
    }
    return markdown(table);
}

std::vector<PassRecord> changedPasses(const std::vector<PassRecord>& passes, const std::vector<PassRecord>& standing) {
    std::vector<PassRecord> changed = passes;
    std::erase_if(changed, [&](const PassRecord& pass) {
        const PassRecord* same = passNamed(standing, pass.name);
        return same != nullptr &&
               std::tie(same->runs, same->vertices, same->draws) == std::tie(pass.runs, pass.vertices, pass.draws);
    });
    return changed;
}

std::string passTable(const std::vector<Record>& records, const std::string& scene) {
    const auto timed = timedRecords(records, scene);
    return timed.empty() ? "" : PassRows(timed).text();
}

std::string passCsv(const std::vector<Record>& records) {
    std::string rows;
    for (const Record& record : records) {
        const auto add = [&](const std::vector<PassRecord>& passes, int width, int height, const char* frame) {
            for (const PassRecord& pass : passes) rows += csvRow(record, width, height, frame, pass);
        };
        add(record.passes, record.width, record.height, "standing");
        add(record.motionPasses, record.width, record.height, "motion");
        add(record.coldPasses, record.width, record.height, "first");
        if (record.otherScreen)
            add(record.otherScreen->passes, record.otherScreen->width, record.otherScreen->height, "standing");
        for (const DeviceCost& cost : record.deviceCosts) add(cost.passes, cost.width, cost.height, "standing");
    }
    if (rows.empty()) return "";
    return "scene,variant,profile,width,height,frame,pass,runs,milliseconds,share,fragments,vertices,draws\n" + rows;
}

} // namespace shadowbench::report
