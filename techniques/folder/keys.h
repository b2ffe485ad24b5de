// The keys of technique.toml and the words that they may have: what the reader takes, the reference in
// docs/technique-folders.md and the JSON Schema for editors (docs/technique.schema.json).
#pragma once

#include "base/words.h"
#include "techniques/folder/description.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

inline constexpr Words<gl::Format, 8> formats{"format",
                                              {{{gl::Format::R8, "R8"},
                                                {gl::Format::RGBA8, "RGBA8"},
                                                {gl::Format::R32F, "R32F"},
                                                {gl::Format::RG16F, "RG16F"},
                                                {gl::Format::RG32F, "RG32F"},
                                                {gl::Format::RGBA16F, "RGBA16F"},
                                                {gl::Format::RGBA32F, "RGBA32F"},
                                                {gl::Format::Depth32F, "Depth32F"}}}};
inline constexpr Words<Answer, 3> answers{
    "answer", {{{Answer::Hard, "hard"}, {Answer::Filtered, "filtered"}, {Answer::Soft, "soft"}}}};
inline constexpr Words<FolderView, 3> views{
    "view", {{{FolderView::Scene, "scene"}, {FolderView::Focused, "focused"}, {FolderView::Sample, "light-sample"}}}};
inline constexpr Words<MapParameters, 2> mapBiases{
    "depth_map", {{{MapParameters::DepthBias, "depth-bias"}, {MapParameters::AnyBias, "any-bias"}}}};
inline constexpr Words<bool, 2> draws{"draw", {{{true, "casters"}, {false, "screen"}}}};
inline constexpr Words<bool, 2> filters{"filter", {{{false, "nearest"}, {true, "linear"}}}}; // whether it is linear
inline constexpr Words<Blend, 4> blends{
    "blend", {{{Blend::Add, "add"}, {Blend::Min, "min"}, {Blend::Max, "max"}, {Blend::Multiply, "multiply"}}}};
inline constexpr Words<Cull, 3> culls{"cull", {{{Cull::None, "none"}, {Cull::Front, "front"}, {Cull::Back, "back"}}}};

enum class KeyTable { Root, Parameter, Target, Pass };

struct FolderKey {
    KeyTable table;
    std::string_view name, meaning;
    std::string_view standard; // what holds without it, as the reference says it; "needed": it must be there
    std::string (*schema)();   // members of its JSON Schema
};

std::span<const FolderKey> folderKeys();

/// The names of a table's keys.
std::vector<std::string> keysOf(KeyTable table);

/// The JSON Schema of technique.toml.
std::string folderSchema();

} // namespace shadowbench::techniques
