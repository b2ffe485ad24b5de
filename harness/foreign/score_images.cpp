#include "harness/foreign/score_images.h"

#include "base/error.h"
#include "base/hash.h"
#include "harness/cells/environment.h"
#include "harness/cells/image_scores.h"
#include "harness/foreign/receivers.h"
#include "harness/foreign/recognition.h"
#include "harness/foreign/visibility.h"
#include "techniques/gl/context.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace shadowbench::foreign {
namespace {

/// The truth that a meaning claims, whether or not the light has it.
Truth claimedTruth(const Light& light, Definition definition) {
    switch (definition) {
    case Definition::Hard:
        return Truth::Hard;
    case Definition::Area:
        return light.isArea() ? Truth::Soft : Truth::Area; // which other lights do not have
    case Definition::Irradiance:
        return light.isEnvironment() ? Truth::Soft : Truth::Irradiance;
    case Definition::SolidAngle:
        return Truth::SolidAngle;
    }
    throw InternalError("images of an unknown meaning");
}

/// Throws BadInput when the scene's light has no such truth.
Truth truthOf(const Scene& scene, Definition definition) {
    const Truth truth = claimedTruth(scene.light, definition);
    if (hasTruth(scene.light, truth)) return truth;
    std::vector<std::string_view> fitting;
    for (const Definition other : allDefinitions)
        if (hasTruth(scene.light, claimedTruth(scene.light, other))) fitting.push_back(name(other));
    throw BadInput(fmt::format("scene {} has a light of kind {}, of which images mean {}, not {}", scene.id,
                               name(scene.light.kind), fmt::join(fitting, " or "), name(definition)));
}

void requireId(const std::string& id) {
    const bool valid = !id.empty() && std::ranges::all_of(id, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    });
    if (!valid)
        throw BadInput(
            fmt::format("\"{}\" is no name for a row: take lower-case letters, digits, \".\", \"_\" and \"-\"", id));
}

std::vector<int> framesOf(const ForeignRow& row) {
    std::vector<int> frames;
    for (const FrameFiles& files : row.frames) frames.push_back(files.frame);
    return frames;
}

/// Whether pixel areas are among a row's truths: under an area light they are for moving frames.
bool usesPixelAreas(const Scene& scene, const ForeignRow& row) {
    const bool moves = row.frames.size() > 1;
    return shadowbench::usesPixelAreas(scene, truthOf(scene, row.definition)) && (moves || !scene.light.isArea());
}

/// Whether hard shadows have smoothed edges: some receiver is neither lit nor shadowed.
bool isGraded(const Image<float>& v, const metrics::Mask& mask) {
    constexpr float rounding = 1.0F / 512;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (mask.scored[i] != 0 && v[i] > rounding && v[i] < 1 - rounding) return true;
    return false;
}

class RowScores {
public:
    RowScores(SceneFrames& frames, const ForeignRow& row, std::vector<std::string>& warnings)
        : frames_(frames), row_(row), warnings_(warnings), truth_(truthOf(frames.scene(), row.definition)),
          receivers_(frames, row) {}

    Record record(CellImages* shown) {
        Record record = blankRecord(frames_.truths(), frames_.scene(), row_);
        std::optional<ImageScores> scores;
        for (const FrameFiles& files : row_.frames) {
            const Image<float> v = read(files);
            const metrics::Mask& mask = receivers_.scored(truth_);
            requireReceivers(mask, files);
            if (!scores)
                scores.emplace(
                    frames_, rule(v, mask), [this](Truth t) -> const metrics::Mask& { return receivers_.scored(t); },
                    record.variant);
            judge(files, v, mask);
            scores->add(files.frame, v, record);
            if (files.frame == frames_.scored()) scoreApart(v, mask, record);
            if (shown != nullptr) shown->frames.emplace(files.frame, v);
        }
        scores->finish(record);
        if (shown != nullptr) shown->reference = &frames_.truths().at(truth_, frames_.scored());
        if (shown != nullptr && shown->wantsFlicker) shown->flicker = scores->flickerMaps();
        record.reason = fmt::format("{}", fmt::join(marks_, "; "));
        return record;
    }

private:
    Image<float> read(const FrameFiles& files) {
        frames_.show(files.frame);
        receivers_.show(files);
        const Reading reading{frames_.scene().size, row_.encoding, row_.channel};
        Visibility visibility = visibilityOf(files, reading, receivers_.seen(truth_).scored, warnings_);
        if (std::ranges::count(visibility.unknown, std::uint8_t{1}) > 0)
            warn(fmt::format("image {} is left out where there is too little light to divide by: {} pixels",
                             files.image.string(), std::ranges::count(visibility.unknown, std::uint8_t{1})));
        receivers_.leaveOut(std::move(visibility.unknown));
        return std::move(visibility.v);
    }

    void requireReceivers(const metrics::Mask& mask, const FrameFiles& files) {
        if (mask.count == 0)
            throw BadInput(
                fmt::format("image {}: no pixel of frame {} is left to score", files.image.string(), files.frame));
    }

    [[nodiscard]] ScoringRule rule(const Image<float>& v, const metrics::Mask& mask) const {
        return {.truth = truth_,
                .graded = isGraded(v, mask) || row_.remembers,
                .pixelAreas = usesPixelAreas(frames_.scene(), row_),
                .remembers = row_.remembers};
    }

    /// Refuses what is certainly not an image of this frame, and names what looks odd.
    void judge(const FrameFiles& files, const Image<float>& v, const metrics::Mask& mask) {
        const bool labels = truth_ == Truth::Hard;
        std::vector<OtherFrame> others;
        for (const FrameFiles& other : row_.frames)
            if (other.frame != files.frame)
                others.push_back({other.frame, frames_.truths().at(truth_, other.frame).visibility});
        const groundtruth::Reference& truth = frames_.truth(truth_);
        const metrics::ScoredFrame frame{v, truth, mask};
        const Compared compared{v, truth.visibility, mask.scored, labels, &frame};
        for (const Finding& finding : oddities(compared, row_.encoding, others)) {
            const std::string sentence =
                fmt::format("image {} (frame {}) {}", files.image.string(), files.frame, finding.sentence);
            if (finding.certain && !row_.force)
                throw BadInput(sentence + "; correct it, or say --force if it is what was meant");
            const std::string kind = finding.sentence.substr(0, finding.sentence.find(':'));
            if (!kinds_.insert(kind).second) continue; // said of an earlier frame
            warn(sentence);
            marks_.push_back(fmt::format("frame {} {}", files.frame, finding.sentence));
        }
    }

    void warn(const std::string& sentence) {
        if (std::ranges::find(warnings_, sentence) == warnings_.end()) warnings_.push_back(sentence);
    }

    /// What pixels away from geometry's edges score: where nothing says what the renderer saw at these, the edges' errors
    /// may be the geometry's. Of rows that do say it, too, so that one that begins to loses no number.
    void scoreApart(const Image<float>& v, const metrics::Mask& mask, Record& record) {
        if (row_.leaveOutEdges) return;
        const groundtruth::Reference& truth = frames_.truth(truth_);
        const metrics::Mask inside = withoutPixels(mask, geometryEdges(truth, frames_.stage().shown().camera));
        if (inside.count == 0) return;
        const metrics::ScoredFrame frame{v, truth, inside};
        if (truth_ == Truth::Hard) record.values["off_geometry_edges.mismatch"] = metrics::labelErrors(frame).mismatch;
        record.values["off_geometry_edges.rmse"] = metrics::rmse(frame);
        record.values["off_geometry_edges.pixels"] = static_cast<double>(inside.count);
    }

    SceneFrames& frames_;
    const ForeignRow& row_;
    std::vector<std::string>& warnings_;
    Truth truth_;
    RowReceivers receivers_;
    std::vector<std::string> marks_; // of what is odd, for the record
    std::set<std::string> kinds_;    // that were said
};

} // namespace

void requireScorable(const Scene& scene, const ForeignRow& row) {
    requireId(row.id);
    truthOf(scene, row.definition);
    const std::vector<int> given = framesOf(row), all = scoredFrames(scene);
    if (given == all || given == std::vector{all.front()}) return;
    throw BadInput(
        fmt::format("row {} has images of the frames {}; scene {} is scored on frame {}, or on all of {}, in this "
                    "order",
                    row.id, fmt::join(given, ", "), scene.id, all.front(), fmt::join(all, ", ")));
}

std::vector<std::pair<Truth, int>> truthsOf(const Scene& scene, const ForeignRow& row) {
    const Truth truth = truthOf(scene, row.definition);
    const int still = scene.timeline.still - 1;
    std::vector<std::pair<Truth, int>> truths;
    for (const int frame : framesOf(row)) {
        truths.emplace_back(truth, frame);
        if (usesPixelAreas(scene, row)) truths.emplace_back(Truth::PixelArea, frame);
    }
    if (scene.light.isArea() && truth == Truth::Hard) truths.emplace_back(Truth::Soft, still);
    if (scene.light.isArea() && (truth == Truth::Hard || truth == Truth::Soft)) truths.emplace_back(Truth::Area, still);
    return truths;
}

std::string cellId(const Truths& truths, const Scene& scene, const ForeignRow& row) {
    std::string inputs = fmt::format("schema 2\n{}\nexternal:{}\nmeans {}\nframes {}\n", scene.id, row.id,
                                     name(row.definition), fmt::join(framesOf(row), " "));
    for (const auto& [key, value] : row.parameters) inputs += fmt::format("{} {}\n", key, value);
    for (const auto& [truth, frame] : truthsOf(scene, row)) inputs += truths.key(truth, frame) + "\n";
    return hash128(inputs).text();
}

Record blankRecord(const Truths& truths, const Scene& scene, const ForeignRow& row) {
    Record record = shadowbench::blankRecord(scene, 1);
    record.technique = std::string(externalPrefix) + row.id;
    record.variant = record.technique;
    record.parameters = {{"means", std::string(name(row.definition))}};
    if (row.remembers) record.parameters.emplace_back("history", "yes");
    if (row.leaveOutEdges) record.parameters.emplace_back("edges", "left-out");
    record.parameters.insert(record.parameters.end(), row.parameters.begin(), row.parameters.end());
    record.environment = environmentOf(gl::Context::current().info());
    record.environment.renderer = row.renderer.empty() ? "not stated" : row.renderer;
    record.environment.gl = notDrawnHere;
    record.environment.rasterThreads = 0;
    record.environment.vectorBits = 0;
    record.environment.mesa.clear();
    record.environment.platform.clear();
    record.environment.vendor.clear();
    record.environment.driver.clear();
    record.tolerances = scene.tolerance;
    record.cell = cellId(truths, scene, row);
    return record;
}

Record scoreImages(SceneFrames& frames, const ForeignRow& row, std::vector<std::string>& warnings, CellImages* shown) {
    requireScorable(frames.scene(), row);
    return RowScores(frames, row, warnings).record(shown);
}

} // namespace shadowbench::foreign
