#include "studies/gpu_cost/pass_work.h"

#include "base/error.h"
#include "gpu/formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>

namespace shadowbench::gpucost {

using shaders::CountedFrame;

const std::vector<PassRecord>& passesOf(const Record& record, CountedFrame frame) {
    return frame == CountedFrame::Standing ? record.passes
           : frame == CountedFrame::First  ? record.coldPasses
                                           : record.motionPasses;
}

namespace {

/// An image that a record counted on.
struct Counted {
    double pixels;
    glm::ivec2 size;
    const std::vector<PassRecord>* passes;
};

std::vector<Counted> countedOn(const Record& record) {
    std::vector<Counted> all;
    const auto add = [&](int width, int height, const std::vector<PassRecord>& passes) {
        if (!passes.empty()) all.push_back({static_cast<double>(width) * height, {width, height}, &passes});
    };
    for (const DeviceCost& cost : record.deviceCosts) add(cost.width, cost.height, cost.passes);
    add(record.width, record.height, record.passes);
    if (record.otherScreen) add(record.otherScreen->width, record.otherScreen->height, record.otherScreen->passes);
    return all;
}

const PassRecord* passNamed(const std::vector<PassRecord>& passes, const std::string& name) {
    const auto found = std::ranges::find(passes, name, &PassRecord::name);
    return found == passes.end() ? nullptr : &*found;
}

std::uint64_t onLine(std::uint64_t a, std::uint64_t b, double share) {
    const double value = static_cast<double>(a) + share * (static_cast<double>(b) - static_cast<double>(a));
    return static_cast<std::uint64_t>(std::llround(std::max(value, 0.0)));
}

/// A pass of a frame: what joins its parts.
class Join {
public:
    Join(const Drawn& drawn, const PassRecord& counts, glm::ivec2 size) : drawn_(drawn), counts_(counts), size_(size) {
        for (const shaders::ShaderCost& shader : drawn.shaders)
            if (isHere(shader.pass) && shader.stage == gpu::Stage::Fragment) draws_ += static_cast<double>(shader.draws);
    }

    gpu::PassWork work() {
        for (const shaders::ShaderCost& shader : drawn_.shaders)
            if (isHere(shader.pass) && shader.draws > 0) addShader(shader);
        for (const shaders::FrameMove& move : drawn_.moves)
            if (isHere(move.pass)) addMove(move);
        work_.triangles = static_cast<double>(counts_.vertices) / 3;
        work_.draws = static_cast<double>(counts_.draws);
        work_.passes = std::min(targets_, static_cast<double>(counts_.runs));
        work_.dependents += targets_ - work_.passes; // a run's second target reads its first: levels, rows then columns
        return work_;
    }

private:
    [[nodiscard]] bool isHere(const std::string& pass) const {
        return pass == counts_.name || (pass.empty() && counts_.name == betweenPasses);
    }

    [[nodiscard]] double pixelsOf(std::pair<int, int> extent) const {
        if (extent == std::pair{drawn_.screen.x, drawn_.screen.y}) extent = {size_.x, size_.y};
        return static_cast<double>(extent.first) * extent.second;
    }

    [[nodiscard]] double pixelsOf(const gpu::Extents& extents) const {
        double pixels = 0;
        for (const auto& [extent, times] : extents) pixels += pixelsOf(extent) * static_cast<double>(times);
        return pixels;
    }

    static double timesOf(const gpu::Extents& extents) {
        double sum = 0;
        for (const auto& [extent, times] : extents) sum += static_cast<double>(times);
        return sum;
    }

    void addShader(const shaders::ShaderCost& shader) {
        if (shader.stage == gpu::Stage::Compute) {
            dispatch(shader);
            work_.dependents += static_cast<double>(shader.draws);
            return;
        }
        const double share = draws_ > 0 ? static_cast<double>(shader.draws) / draws_ : 0;
        if (shader.stage == gpu::Stage::Vertex) {
            run(shader, share * static_cast<double>(counts_.vertices));
            return;
        }
        targets_ += timesOf(shader.output.extents);
        const bool isDepthAlone = shader.output.colours.empty();
        // Where no record counts fragments of depth alone, the target is taken to be covered once.
        const double fragments = isDepthAlone && counts_.fragments == 0 ? pixelsOf(shader.output.extents)
                                                                        : share * static_cast<double>(counts_.fragments);
        if (counts_.fragments > 0) run(shader, fragments);
        for (const std::string& colour : shader.output.colours)
            work_.output.push_back({fragments, gpu::bytesOf(colour), gpu::hasFullFloats(colour), shader.output.blends});
        if (shader.output.writesDepth)
            work_.depthPixels += fragments;
        else if (isDepthAlone)
            work_.testedPixels += fragments;
    }

    /// What it executes, where that is counted; else what the compiler guesses.
    void run(const shaders::ShaderCost& shader, double count) {
        const auto guessed = static_cast<double>(shader.of("Inverse Throughput"));
        if (!shader.executed) {
            work_.shading.push_back({count, guessed, guessed});
            return;
        }
        run(*shader.executed, count);
    }

    void run(const gpu::Executed& executed, double count) {
        work_.shading.push_back({count, executed.cycles64, executed.cycles32, executed.longest64, executed.longest32});
        work_.reads += count * executed.textureReads;
    }

    /// By the power of the number of pixels that goes through the two images that it was counted on; what is less on the
    /// larger one stays as it is there.
    void dispatch(const shaders::ShaderCost& shader) {
        if (!shader.executed || !shader.larger) return run(shader, pixelsOf(shader.output.extents));
        const double drawn = static_cast<double>(drawn_.screen.x) * drawn_.screen.y;
        const double pixels = std::log(static_cast<double>(size_.x) * size_.y / drawn);
        const double power = pixels / std::log(shaders::largerBy * shaders::largerBy);
        const auto at = [power](double small, double large) {
            return small > 0 && large > small ? small * std::pow(large / small, power) : large;
        };
        const gpu::Executed &small = *shader.executed, &large = shader.larger->executed;
        run({at(small.cycles32, large.cycles32), at(small.cycles64, large.cycles64), at(small.longest32, large.longest32),
             at(small.longest64, large.longest64), at(small.textureReads, large.textureReads),
             at(small.bufferReads, large.bufferReads), at(small.stores, large.stores)},
            at(pixelsOf(shader.output.extents), pixelsOf(shader.larger->extents)));
    }

    void addMove(const shaders::FrameMove& move) {
        const double pixels = pixelsOf(move.extents), times = timesOf(move.extents);
        if (move.kind == gpu::MoveKind::ReadBack) {
            work_.readBacks += times;
            return;
        }
        if (move.format.starts_with("Depth"))
            work_.depthPixels += pixels;
        else
            write(move.kind == gpu::MoveKind::Mipmap ? pixels / 3 : pixels, move.format); // 1/4 + 1/16 + …
        if (move.kind == gpu::MoveKind::Copy) work_.dependents += times;
        if (move.kind == gpu::MoveKind::Mipmap)
            for (const auto& [extent, often] : move.extents)
                work_.dependents +=
                    static_cast<double>(often) * (std::bit_width(static_cast<unsigned>(std::max(extent.first, 1))) - 1);
    }

    void write(double pixels, const std::string& format) {
        work_.output.push_back({pixels, gpu::bytesOf(format), gpu::hasFullFloats(format), false});
    }

    const Drawn& drawn_;
    const PassRecord& counts_;
    glm::ivec2 size_;
    gpu::PassWork work_;
    double draws_ = 0, targets_ = 0; // of the pipelines that rasterise
};

/// Whether a pass draws as many fragments on an image of another size: none of its targets is the screen then, though one
/// may happen to be as large as the screen that was drawn was.
bool isOfMap(const Record& record, const PassRecord* standing, glm::ivec2 size) {
    const PassRecord* small = standing == nullptr ? nullptr : passNamed(record.passes, standing->name);
    return size != glm::ivec2(record.width, record.height) && small != nullptr && standing->fragments > 0 &&
           standing->fragments == small->fragments;
}

/// Nothing for a record that counted on one other size alone.
std::optional<std::vector<PassRecord>> countsOf(const Record& record, glm::ivec2 size) {
    std::vector<Counted> counted = countedOn(record);
    const double pixels = static_cast<double>(size.x) * size.y;
    for (const Counted& each : counted)
        if (each.size == size) return *each.passes;
    std::ranges::sort(counted, {}, [pixels](const Counted& each) { return std::abs(std::log(each.pixels / pixels)); });
    const auto other =
        std::ranges::find_if(counted, [&](const Counted& each) { return each.pixels != counted.front().pixels; });
    if (other == counted.end()) return std::nullopt;
    const double share = (pixels - counted.front().pixels) / (other->pixels - counted.front().pixels);
    std::vector<PassRecord> passes = *counted.front().passes;
    for (PassRecord& pass : passes)
        if (const PassRecord* there = passNamed(*other->passes, pass.name)) {
            pass.fragments = onLine(pass.fragments, there->fragments, share);
            pass.vertices = onLine(pass.vertices, there->vertices, share);
            pass.draws = onLine(pass.draws, there->draws, share);
        }
    return passes;
}

/// Whether a pass draws into a target as large as the screen.
bool growsWithScreen(const Drawn& drawn, const std::string& pass) {
    return std::ranges::any_of(drawn.shaders, [&](const shaders::ShaderCost& shader) {
        return shader.pass == pass && shader.output.extents.contains({drawn.screen.x, drawn.screen.y});
    });
}

std::uint64_t grown(std::uint64_t count, double large, double small) {
    return small > 0 ? static_cast<std::uint64_t>(std::llround(static_cast<double>(count) * large / small)) : count;
}

/// What passes of another frame than the standing one count on an image of `size` pixels, on which that counts `standing`.
std::vector<PassRecord> countsOfOther(const Cell& cell, const Drawn& drawn, glm::ivec2 size, CountedFrame frame,
                                      const std::vector<PassRecord>& standing) {
    const auto record = std::ranges::find_if(cell, [&](const Record* each) { return !passesOf(*each, frame).empty(); });
    if (record == cell.end()) return {};
    const double pixels = static_cast<double>(size.x) * size.y;
    const double drawnPixels = static_cast<double>((*record)->width) * (*record)->height;
    std::vector<PassRecord> passes = passesOf(**record, frame);
    for (PassRecord& pass : passes) {
        const PassRecord *small = passNamed((*record)->passes, pass.name), *large = passNamed(standing, pass.name);
        if (small != nullptr && large != nullptr) {
            const auto grow = [&](std::uint64_t PassRecord::*count) {
                pass.*count = grown(pass.*count, static_cast<double>(large->*count), static_cast<double>(small->*count));
            };
            for (const auto count : {&PassRecord::fragments, &PassRecord::vertices, &PassRecord::draws}) grow(count);
        } else if (growsWithScreen(drawn, pass.name)) {
            pass.fragments = grown(pass.fragments, pixels, drawnPixels);
        }
    }
    return passes;
}

} // namespace

std::vector<PassRecord> countsOn(const Cell& cell, glm::ivec2 size) {
    std::optional<std::vector<PassRecord>> counts;
    for (const Record* record : cell) {
        const auto here = countsOf(*record, size);
        if (!here) continue;
        if (!counts) counts = here;
        for (PassRecord& pass : *counts)
            if (const PassRecord* same = passNamed(*here, pass.name); same != nullptr && pass.fragments == 0)
                pass.fragments = same->fragments;
    }
    if (!counts)
        throw BadInput(
            fmt::format("the records of {} on {} count the work of passes on one size of image alone, so what grows "
                        "with the screen is not known; name a record that counts on two, too",
                        cell.front()->variant, cell.front()->scene));
    return *counts;
}

std::vector<NamedWork> worksOf(const Cell& cell, const Drawn& drawn, glm::ivec2 size, CountedFrame frame) {
    const std::vector<PassRecord> standing = countsOn(cell, size);
    std::vector<NamedWork> works;
    for (const PassRecord& counts :
         frame == CountedFrame::Standing ? standing : countsOfOther(cell, drawn, size, frame, standing)) {
        const bool ofMap = isOfMap(*cell.front(), passNamed(standing, counts.name), size);
        works.push_back({counts.name, Join(drawn, counts, ofMap ? drawn.screen : size).work()});
    }
    return works;
}

} // namespace shadowbench::gpucost
