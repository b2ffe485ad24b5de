#include "harness/foreign/recognition.h"

#include "base/srgb.h"
#include "harness/foreign/encodings.h"
#include "harness/foreign/foreign_image.h"
#include "harness/foreign/shadow_edges.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace shadowbench::foreign {
namespace {

constexpr float nearlyNothing = 1.0F / 256; // below the first step of an 8-bit file

bool isLit(float v) { return v >= 0.5F; }

double loss(float v, float truth, bool labels) {
    if (labels) return isLit(v) == isLit(truth) ? 0 : 1;
    const double difference = static_cast<double>(v) - static_cast<double>(truth);
    return difference * difference;
}

/// A mean of losses as an error.
double asError(double meanLoss, bool labels) { return labels ? meanLoss : std::sqrt(meanLoss); }

std::string percent(double share) {
    return share >= 0.1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
}

std::string fall(double before, double after, bool labels) {
    if (labels) return fmt::format("mismatch falls from {} to {}", percent(before), percent(after));
    return fmt::format("the rms error falls from {:.2g} to {:.2g}", before, after);
}

/// Whether so much error goes that nothing but a mistake explains it: half of it, and more than a technique's odd pixels.
bool halves(double before, double after, bool labels) {
    const double notable = labels ? 0.003 : 0.02;
    return after <= before / 2 && before - after >= notable;
}

template <class Source>
Image<float> rearranged(const Image<float>& image, Source source) {
    Image<float> result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) result(x, y) = source(x, y);
    return result;
}

/// One way in which an image can be wrong, undone.
struct Undone {
    std::string_view looks, by;
    Image<float> v;
    bool inverts = false;
};

std::vector<Undone> turnsOf(const Image<float>& v) {
    const int right = v.width() - 1, bottom = v.height() - 1;
    std::vector<Undone> all;
    all.push_back({"upside down", "flipped", rearranged(v, [&](int x, int y) { return v(x, bottom - y); })});
    all.push_back({"mirrored", "left and right are swapped", rearranged(v, [&](int x, int y) { return v(right - x, y); })});
    all.push_back(
        {"turned by half a turn", "turned back", rearranged(v, [&](int x, int y) { return v(right - x, bottom - y); })});
    if (v.width() == v.height())
        all.push_back({"transposed", "rows and columns are swapped", rearranged(v, [&](int x, int y) { return v(y, x); })});
    all.push_back({"inverted (1 is lit, 0 is shadow)", "subtracted from 1",
                   rearranged(v, [&](int x, int y) { return 1 - v(x, y); }), true});
    return all;
}

double errorWith(const Compared& compared, const Image<float>& v) {
    return errorOf({v, compared.truth, compared.scored, compared.labels});
}

/// The error of the best image that is the same everywhere.
double errorOfOneGrey(const Compared& compared) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < compared.truth.size(); ++i) {
        if (compared.scored[i] == 0) continue;
        sum += static_cast<double>(compared.truth[i]);
        ++count;
    }
    const Image<float> grey(compared.v.width(), compared.v.height(), static_cast<float>(count > 0 ? sum / count : 0));
    return errorWith(compared, grey);
}

// Shifts.

constexpr int longestShift = 2; // pixels that an image may be shifted by
constexpr int squares = 8;      // of the image, along each side
constexpr int enoughAre = 5;    // squares that a shift must better

/// Losses in each square of an image.
using Losses = std::vector<double>;

/// The scored pixels around which all are scored as far as an image may be shifted: geometry's edges say nothing there.
Image<std::uint8_t> inner(const Image<std::uint8_t>& scored) {
    Image<std::uint8_t> result(scored.width(), scored.height());
    for (int y = longestShift; y < scored.height() - longestShift; ++y)
        for (int x = longestShift; x < scored.width() - longestShift; ++x) {
            bool all = true;
            for (int dy = -longestShift; dy <= longestShift && all; ++dy)
                for (int dx = -longestShift; dx <= longestShift && all; ++dx) all = scored(x + dx, y + dy) != 0;
            result(x, y) = all ? 1 : 0;
        }
    return result;
}

Losses lossesWith(const Compared& compared, const Image<std::uint8_t>& pixels, glm::ivec2 by) {
    Losses losses(squares * squares);
    const int width = compared.v.width(), height = compared.v.height();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (pixels(x, y) == 0) continue;
            const auto square = static_cast<std::size_t>(y * squares / height * squares + x * squares / width);
            losses[square] += loss(compared.v(x + by.x, y + by.y), compared.truth(x, y), compared.labels);
        }
    return losses;
}

double sumOf(const Losses& losses) {
    double sum = 0;
    for (const double value : losses) sum += value;
    return sum;
}

/// Squares that become better and worse.
struct Votes {
    int better = 0, worse = 0;
};
Votes votes(const Losses& before, const Losses& after, bool labels) {
    const double notable = labels ? 2 : 0.5; // less is an odd pixel
    Votes result;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] + after[i] < notable) continue;
        if (after[i] < before[i]) ++result.better;
        if (after[i] > before[i]) ++result.worse;
    }
    return result;
}

/// An image moved back.
struct Moved {
    glm::ivec2 by{0, 0};
    Losses losses;
};

/// By as many whole pixels as leave the least; by none where none is better.
Moved bestMoved(const Compared& compared, const Image<std::uint8_t>& pixels, const Losses& before) {
    Moved best{{0, 0}, before};
    for (int y = -longestShift; y <= longestShift; ++y)
        for (int x = -longestShift; x <= longestShift; ++x) {
            Losses losses = lossesWith(compared, pixels, {x, y});
            if (sumOf(losses) < sumOf(best.losses)) best = {{x, y}, std::move(losses)};
        }
    return best;
}

Finding shiftFinding(const Compared& compared, const Image<std::uint8_t>& pixels, const Losses& before, const Moved& moved,
                     bool certain) {
    const auto count = static_cast<double>(std::ranges::count(pixels, std::uint8_t{1}));
    const double was = asError(sumOf(before) / count, compared.labels);
    const double is = asError(sumOf(moved.losses) / count, compared.labels);
    const Votes found = votes(before, moved.losses, compared.labels);
    return {fmt::format("looks shifted by ({}, {}) pixels: {} when moved back, in {} of {} parts of the image with shadow "
                        "edges",
                        moved.by.x, moved.by.y, fall(was, is, compared.labels), found.better, found.better + found.worse),
            certain};
}

float asItIs(float v) { return v; }

/// How an encoding is undone, and what to say of it.
struct Misread {
    float (*undo)(float);
    std::string looks, remedy;
};
Misread misreadOf(Encoding encoding) {
    if (encoding == Encoding::Srgb) return {srgbFromLinear, "linear, and was decoded from sRGB", "say --linear"};
    return {linearFromSrgb, "sRGB-encoded", "say --srgb, or write linear numbers"};
}

/// Whether the grey values that pixels share are codes of a filter's fractions.
std::optional<Finding> misencodedFractions(const Compared& compared, Encoding encoding) {
    const bool decoded = encoding == Encoding::Srgb;
    std::vector<float> stored;
    for (std::size_t i = 0; i < compared.v.size(); ++i)
        if (compared.scored[i] != 0) stored.push_back(decoded ? srgbFromLinear(compared.v[i]) : compared.v[i]);
    const EncodedFractions linear = encodedFractions(stored, asItIs), srgb = encodedFractions(stored, srgbFromLinear);
    const EncodedFractions& found = decoded ? linear : srgb;
    if (!isSure(found, decoded ? srgb : linear)) return {};
    const Misread misread = misreadOf(encoding);
    return Finding{fmt::format("looks {}: its grey values are those of a filter of {} samples when that is undone, {} of "
                               "which chance does not explain; {}",
                               misread.looks, found.samples, found.levels, misread.remedy),
                   true};
}

std::optional<Finding> misencodedShares(const Compared& compared, Encoding encoding) {
    const Misread misread = misreadOf(encoding);
    Image<float> v = compared.v;
    std::ranges::transform(v, v.begin(), misread.undo);
    const double before = errorOf(compared), after = errorWith(compared, v);
    if (!halves(before, after, false)) return {};
    return Finding{
        fmt::format("looks {}: {} when that is undone; {}", misread.looks, fall(before, after, false), misread.remedy),
        true};
}

std::optional<Finding> misencodedLabels(const Compared& compared, Encoding encoding) {
    if (compared.frame == nullptr) return {};
    const Misread misread = misreadOf(encoding);
    const GreyPixels grey = greyPixels(*compared.frame, misread.undo);
    if (!isSuspect(grey)) return {};
    const std::string average = std::abs(grey.after) < std::abs(grey.before)
                                    ? fmt::format("{:.2g} too {} on average, and {:.2g}", std::abs(grey.before),
                                                  grey.before > 0 ? "bright" : "dark", std::abs(grey.after))
                                    : "evenly bright and dark only";
    return Finding{fmt::format("looks {}: its grey pixels at shadow edges are {} when that is undone; {}", misread.looks,
                               average, misread.remedy),
                   false};
}

} // namespace

double errorOf(const Compared& compared) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < compared.v.size(); ++i) {
        if (compared.scored[i] == 0) continue;
        sum += loss(compared.v[i], compared.truth[i], compared.labels);
        ++count;
    }
    return count > 0 ? asError(sum / static_cast<double>(count), compared.labels) : 0;
}

std::optional<Finding> uniform(const Compared& compared) {
    constexpr double most = 0.01; // of the receivers: fewer may be wrong without a mistake in the whole image
    float low = 1, high = 0;
    std::size_t lit = 0, shadowed = 0;
    for (std::size_t i = 0; i < compared.v.size(); ++i) {
        if (compared.scored[i] == 0) continue;
        low = std::min(low, compared.v[i]);
        high = std::max(high, compared.v[i]);
        ++(isLit(compared.truth[i]) ? lit : shadowed);
    }
    if (high - low > nearlyNothing || lit + shadowed == 0) return {};
    const double all = static_cast<double>(lit + shadowed);
    if (high<nearlyNothing&& static_cast<double>(lit)> most * all)
        return Finding{fmt::format("is black: no receiver has light, and {:.2g} % of them should",
                                   100 * static_cast<double>(lit) / all),
                       true};
    if (low > 1 - nearlyNothing && static_cast<double>(shadowed) > most * all)
        return Finding{fmt::format("shows no shadow: all receivers are fully lit, and {:.2g} % of them should not be",
                                   100 * static_cast<double>(shadowed) / all),
                       false};
    if (low < nearlyNothing || low > 1 - nearlyNothing) return {};
    return Finding{fmt::format("is of one grey: all receivers have the visibility {:.3g}", low), true};
}

std::optional<Finding> turned(const Compared& compared) {
    const double before = errorOf(compared);
    std::optional<Finding> best;
    double least = before;
    for (const Undone& undone : turnsOf(compared.v)) {
        const double after = errorWith(compared, undone.v);
        if (after >= least || !halves(before, after, compared.labels)) continue;
        least = after;
        // What shadows itself nearly everywhere would be as good as lit everywhere when it is inverted.
        const bool certain = !undone.inverts || halves(errorOfOneGrey(compared), after, compared.labels);
        best = Finding{fmt::format("looks {}: {} when {}", undone.looks, fall(before, after, compared.labels), undone.by),
                       certain};
    }
    return best;
}

std::optional<Finding> shifted(const Compared& compared) {
    const Image<std::uint8_t> pixels = inner(compared.scored);
    const Losses before = lossesWith(compared, pixels, {0, 0});
    ShiftEvidence evidence;
    std::optional<Finding> byEdges;
    if (compared.frame != nullptr) {
        evidence = shiftEvidence(*compared.frame, compared.labels);
        const Moved moved{evidence.by, lossesWith(compared, pixels, evidence.by)};
        if (isSuspect(evidence) && sumOf(moved.losses) < sumOf(before))
            byEdges = shiftFinding(compared, pixels, before, moved, isSure(evidence));
    }
    if (byEdges && byEdges->certain) return byEdges;
    const Moved best = bestMoved(compared, pixels, before);
    const Votes found = votes(before, best.losses, compared.labels);
    const double share = sumOf(best.losses) / sumOf(before);
    if (found.better < enoughAre || found.worse > found.better / 2 || share > 0.85) return byEdges;
    const bool agree = compared.frame == nullptr || evidence.by == best.by;
    return shiftFinding(compared, pixels, before, best, agree && found.worse <= found.better / 5 && share <= 0.65);
}

std::optional<Finding> misencoded(const Compared& compared, Encoding encoding) {
    auto found = compared.labels ? std::nullopt : misencodedShares(compared, encoding);
    if (!found) found = misencodedFractions(compared, encoding);
    return found || !compared.labels ? found : misencodedLabels(compared, encoding);
}

std::optional<Finding> shaded(const Compared& compared) {
    std::vector<float> lit;
    for (std::size_t i = 0; i < compared.v.size(); ++i)
        if (compared.scored[i] != 0 && compared.truth[i] > 0.999F) lit.push_back(compared.v[i]);
    if (lit.size() < 64) return {};
    const auto high = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() * 9 / 10);
    std::nth_element(lit.begin(), high, lit.end());
    if (*high >= 0.9F || *high < nearlyNothing) return {};
    return Finding{fmt::format("looks like a shaded picture: nine in ten of the fully lit receivers are no brighter than "
                               "{:.2g}; visibility is 1 there, and is had with --lit and --unlit",
                               *high),
                   false};
}

std::optional<Finding> ofAnotherFrame(const Compared& compared, const std::vector<OtherFrame>& others) {
    const double before = errorOf(compared);
    std::optional<Finding> best;
    double least = before;
    for (const OtherFrame& other : others) {
        const double after = errorOf({compared.v, other.truth, compared.scored, compared.labels});
        if (after >= least || !halves(before, after, compared.labels)) continue;
        least = after;
        best = Finding{
            fmt::format("looks like frame {}: {} against its truth", other.frame, fall(before, after, compared.labels)),
            true};
    }
    return best;
}

std::vector<Finding> oddities(const Compared& compared, Encoding encoding, const std::vector<OtherFrame>& others) {
    if (const auto found = uniform(compared)) return {*found};
    std::vector<Finding> all;
    if (auto found = turned(compared))
        all.push_back(*found);
    else if (found = ofAnotherFrame(compared, others); found)
        all.push_back(*found);
    else if (found = shifted(compared); found)
        all.push_back(*found);
    if (const auto found = misencoded(compared, encoding)) all.push_back(*found);
    if (const auto found = shaded(compared)) all.push_back(*found);
    return all;
}

} // namespace shadowbench::foreign
