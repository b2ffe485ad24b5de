// Marks in the text of a shader, so that how often a lane takes each loop and branch can be counted, and found again in
// machine code.
#pragma once

#include "gpu/pipeline.h"

#include <string>

namespace shadowbench::gpu {

/// A shader after the preprocessor, with `SB_MARK(k);` as the first statement of main (0), of each loop's body and of each
/// side of an if, after each label of a switch, and behind each statement that a lane may leave by return, discard, break
/// or continue. `&&`, `||` and `?:` have none: what they choose between is computed on both sides more often than not.
struct Marked {
    std::string head; // #version and #extension
    std::string body; // in which main is called sbMain, and `SB_LEAVE` stands before each discard
    unsigned marks = 1;
    bool hasInner = false; // marks in loops of constant length: `SB_INNER(k);`
    bool discards = false;
};

/// Throws BadInput for text that is no GLSL.
Marked marked(const Shader& shader);

/// GLSL for OpenGL that draws the same bits and adds for each of its invocations how often it passed each mark to the words
/// of the storage buffer at `binding`: word 4 + marks × invocation + mark. Invocations of a fragment shader are numbered row
/// by row of an image as wide as word 0 says, those of a compute shader group by group. Of bands of as many of them as word
/// 1 says, each word 2-th is counted, one behind another.
std::string countingText(const Marked& marked, Stage stage, unsigned binding);

/// GLSL for Vulkan in which mark k stores the word firstPlace + k; without `inner`, those in loops of constant length do
/// not.
std::string placingText(const Marked& marked, bool inner = true);
inline constexpr unsigned firstPlace = 0x5B000000, mostMarks = 0x10000;

} // namespace shadowbench::gpu
