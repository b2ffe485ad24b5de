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

inline constexpr Words<gl::Format, 11> formats{"format",
                                               {{{gl::Format::R8, "R8"},
                                                 {gl::Format::RGBA8, "RGBA8"},
                                                 {gl::Format::R32F, "R32F"},
                                                 {gl::Format::RG16F, "RG16F"},
                                                 {gl::Format::RG32F, "RG32F"},
                                                 {gl::Format::RGBA16, "RGBA16"},
                                                 {gl::Format::RGBA16F, "RGBA16F"},
                                                 {gl::Format::RGBA32F, "RGBA32F"},
                                                 {gl::Format::RG32UI, "RG32UI"},
                                                 {gl::Format::Depth32F, "Depth32F"},
                                                 {gl::Format::Depth32FStencil8, "Depth32FStencil8"}}}};
inline constexpr Words<Answer, 3> answers{
    "answer", {{{Answer::Hard, "hard"}, {Answer::Filtered, "filtered"}, {Answer::Soft, "soft"}}}};
inline constexpr Words<FolderView, 6> views{"view",
                                            {{{FolderView::Scene, "scene"},
                                              {FolderView::Focused, "focused"},
                                              {FolderView::Lispsm, "lispsm"},
                                              {FolderView::Sample, "light-sample"},
                                              {FolderView::Cube, "cube"},
                                              {FolderView::Cascades, "cascades"}}}};
inline constexpr Words<bool, 2> cascadeFits{"fit", {{{true, "visible"}, {false, "view"}}}};
inline constexpr Words<bool, 2> cascadeWarps{"warp", {{{true, "lispsm"}, {false, "none"}}}};
inline constexpr Words<bool, 2> cascadeTexels{"stable", {{{true, "texels"}, {false, "none"}}}};
inline constexpr Words<MapParameters, 2> mapBiases{
    "depth_map", {{{MapParameters::DepthBias, "depth-bias"}, {MapParameters::AnyBias, "any-bias"}}}};
inline constexpr Words<PassKind, 2> draws{"draw", {{{PassKind::Casters, "casters"}, {PassKind::Screen, "screen"}}}};
inline constexpr Words<bool, 2> filters{"filter", {{{false, "nearest"}, {true, "linear"}}}}; // whether it is linear
inline constexpr Words<bool, 1> changes{"once", {{{true, "light"}}}};
inline constexpr Words<Blend, 4> blends{
    "blend", {{{Blend::Add, "add"}, {Blend::Min, "min"}, {Blend::Max, "max"}, {Blend::Multiply, "multiply"}}}};
inline constexpr Words<Cull, 3> culls{"cull", {{{Cull::None, "none"}, {Cull::Front, "front"}, {Cull::Back, "back"}}}};
inline constexpr Words<StencilTest, 3> stencilTests{
    "test", {{{StencilTest::Always, "always"}, {StencilTest::Equal, "equal"}, {StencilTest::NotEqual, "not-equal"}}}};
inline constexpr Words<StencilOperation, 5> stencilOperations{"operation",
                                                              {{{StencilOperation::Keep, "keep"},
                                                                {StencilOperation::Replace, "replace"},
                                                                {StencilOperation::Increment, "increment"},
                                                                {StencilOperation::Decrement, "decrement"},
                                                                {StencilOperation::Invert, "invert"}}}};

inline constexpr Words<PatternKind, 5> patternKinds{"kind",
                                                    {{{PatternKind::PoissonDisk, "poisson-disk"},
                                                      {PatternKind::PoissonLight, "poisson-light"},
                                                      {PatternKind::Grid, "grid"},
                                                      {PatternKind::Gaussian, "gaussian"},
                                                      {PatternKind::Jitter, "jitter"}}}};
inline constexpr Words<MapBias, 2> biases{"offset", {{{MapBias::Parameters, "bias"}, {MapBias::Slope, "bias-of-slope"}}}};

enum class KeyTable { Root, Cascades, Parameter, Pattern, Target, Pass, Stencil };

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
