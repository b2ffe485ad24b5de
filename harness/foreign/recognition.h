// Detects flips, shifts and encodings of whole images by undoing each and comparing the error. Pure functions.
#pragma once

#include "base/image.h"
#include "harness/foreign/foreign_row.h"
#include "harness/metrics/frames.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::foreign {

/// An image with what is true of it; all of one size.
struct Compared {
    const Image<float>& v;
    const Image<float>& truth;
    const Image<std::uint8_t>& scored; // 1 at receivers
    bool labels = false;               // the truth is 0 or 1: errors are shares of wrong labels, else root mean squares
    const metrics::ScoredFrame* frame = nullptr; // with surfaces and, of labels, distances from edges; null: unknown
};

/// Share of the scored pixels with the wrong label (lit: ≥ ½), or the root mean square of V − V*. 0 without such pixels.
double errorOf(const Compared& compared);

struct Finding {
    std::string sentence; // "looks upside down: mismatch falls from 31 % to 0.9 % when flipped"
    bool certain = false; // else suspected
};

/// No shadow boundary at all: all receivers without light though some have it (certain), all of one grey (certain), or all
/// fully lit though some have none (suspected: a renderer without shadows draws that).
std::optional<Finding> uniform(const Compared& compared);

/// Flipped about either axis or both, rows and columns swapped, or 1 − V. Certain where undoing it halves the error; 1 − V,
/// where it also halves that of the best single grey, else suspected.
std::optional<Finding> turned(const Compared& compared);

/// Shifted by up to two whole pixels each way. Certain where the whole frame is known and leaves no doubt
/// (harness/foreign/shadow_edges.h), and where undoing it takes a third of the error, of nearly all squares of the image,
/// and the frame does not say otherwise: a shift makes all squares better when it is undone, a shadow map's errors some
/// better and some worse.
std::optional<Finding> shifted(const Compared& compared);

/// sRGB-encoded though taken for linear, or linear though decoded. Certain where the image's grey values are codes of a
/// filter's fractions (harness/foreign/encodings.h), and for graded truths where undoing it halves the error. Suspected
/// where the truth has labels and distances from their edges, and the grey pixels at these are as an edge's when it is
/// undone.
std::optional<Finding> misencoded(const Compared& compared, Encoding encoding);

/// Brightest receivers well below 1 though much is fully lit: a shaded picture. Suspected.
std::optional<Finding> shaded(const Compared& compared);

struct OtherFrame {
    int frame;
    const Image<float>& truth;
};

/// Nearer to the truth of another frame: certain where the error is half of that.
std::optional<Finding> ofAnotherFrame(const Compared& compared, const std::vector<OtherFrame>& others);

/// All findings, the strongest evidence first; at most one of: turned, shifted, of another frame.
std::vector<Finding> oddities(const Compared& compared, Encoding encoding, const std::vector<OtherFrame>& others);

} // namespace shadowbench::foreign
