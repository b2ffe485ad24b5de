// What is kept and printed for programs, as text.
#pragma once

#include "studies/shader_cost/shader_cost.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::shaders {

/// The shaders of a pipeline: stage and file.
using FrameShaders = std::vector<std::pair<gpu::Stage, std::string>>;

/// A pipeline of a frame without its sources.
struct FramePipeline {
    std::string pass;
    std::uint64_t draws = 0;
    std::string digest; // gpu::Pipeline::digest
    FrameShaders shaders;
    Output output;
    gpu::WavePasses passes = {};                                         // as of gpu::Use
    std::optional<std::pair<gpu::Extents, gpu::WavePasses>> larger = {}; // of dispatches, as of Larger
};

/// Of one technique on one scene.
struct FrameList {
    std::vector<FramePipeline> pipelines;
    std::vector<FrameMove> moves; // without technique and scene
    std::string frame = {};       // as of ShaderCost
};

/// Back from text throws BadInput where it is damaged.
std::string toText(const FrameList& list);
FrameList frameList(const std::string& text);

/// The inverse of toLines; `name` stands for the text in messages.
ShaderCosts parseLines(const std::string& text, const std::string& name);

} // namespace shadowbench::shaders
