#include "groundtruth/cgal/hard/pixel_patches.h"

#include <limits>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr std::size_t fewEdges = 128;             // whose crossings are found, too
constexpr std::size_t manyEdges = 1024;           // from here on no strip ends are found
constexpr double leastStrip = 1e-12;              // px; thinner ones are left out
constexpr double sameDepth = 1e-12;               // relative: nearer together, two patches are one surface
constexpr double surelySeen = 1e-6;               // px²; the strips through a patch of this area have one, too
constexpr double rounding = 1e-7;                 // of a share that is kept as a float
constexpr double largestSigma = 0.0095;           // of the share of a pixel
constexpr int fewestLines = 32, mostLines = 4096; // across a pixel

struct PatchEdge {
    glm::dvec2 from, to;
};

/// What a horizontal line through the pixel meets.
struct Lengths {
    double seen = 0, lit = 0;
    bool crossing = false; // of patches, in depth
};

/// Reads one line after the other; keeps its working space.
class LineReader {
public:
    explicit LineReader(const std::vector<Patch>& patches) : patches_(patches), shadows_(patches.size()) {}

    Lengths at(double y) {
        y_ = y;
        lengths_ = {};
        spans_.clear();
        cuts_.clear();
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            const std::optional<ImagePolygon::Interval> inside = patches_[i].outline.onLine(y);
            if (!inside || !(inside->from < inside->to)) continue;
            spans_.push_back({*inside, &patches_[i], &shadows_[i]});
            shadows_[i].known = false;
            cuts_.push_back(inside->from);
            cuts_.push_back(inside->to);
        }
        std::ranges::sort(cuts_);
        for (std::size_t i = 1; i < cuts_.size(); ++i)
            if (cuts_[i - 1] < cuts_[i]) addBetween(cuts_[i - 1], cuts_[i]);
        return lengths_;
    }

private:
    struct Shadows {
        std::vector<ImagePolygon::Interval> onLine;
        bool known = false;
    };
    struct Span {
        ImagePolygon::Interval inside;
        const Patch* patch;
        Shadows* shadows; // of the patch, once they are needed
        [[nodiscard]] double nearness(double x, double y) const { return patch->nearness(x, y); }
    };
    static constexpr int mostSplits = 8;

    /// Between two cuts the same patches lie behind one another.
    void addBetween(double from, double to) {
        const double middle = 0.5 * (from + to);
        behindOneAnother_.clear();
        for (const Span& span : spans_)
            if (middle >= span.inside.from && middle <= span.inside.to) behindOneAnother_.push_back(&span);
        if (!behindOneAnother_.empty()) addNearest(from, to, mostSplits);
    }

    [[nodiscard]] const Span* nearest(double x) const {
        const Span* best = nullptr;
        double most = 0;
        for (const Span* span : behindOneAnother_) {
            const double nearness = span->nearness(x, y_);
            if (best != nullptr && nearness <= most * (1 + sameDepth)) continue;
            best = span;
            most = nearness;
        }
        return best;
    }

    /// Inverse depths are linear, so what is nearest at both ends is nearest between them.
    void addNearest(double from, double to, int splits) {
        const Span *left = nearest(from), *right = nearest(to);
        const double ahead = left->nearness(from, y_) - right->nearness(from, y_);
        const double behind = right->nearness(to, y_) - left->nearness(to, y_);
        const bool cross =
            left != right && ahead > sameDepth * left->nearness(from, y_) && behind > sameDepth * right->nearness(to, y_);
        if (!cross || splits == 0) return add(*nearest(0.5 * (from + to)), from, to); // ends may be ties
        lengths_.crossing = true;
        const double at = from + ahead / (ahead + behind) * (to - from);
        addNearest(from, at, splits - 1);
        addNearest(at, to, splits - 1);
    }

    void add(const Span& span, double from, double to) {
        if (!span.patch->counts) return;
        lengths_.seen += to - from;
        if (span.patch->shadowed) return;
        double reached = from;
        for (const ImagePolygon::Interval& shadow : shadowsOf(span)) {
            if (shadow.from > reached) lengths_.lit += std::min(shadow.from, to) - reached;
            reached = std::max(reached, shadow.to);
            if (reached >= to) return;
        }
        lengths_.lit += to - reached;
    }

    [[nodiscard]] const std::vector<ImagePolygon::Interval>& shadowsOf(const Span& span) const {
        auto& [onLine, known] = *span.shadows;
        if (known) return onLine;
        known = true;
        onLine.clear();
        for (const ImagePolygon& shadow : span.patch->shadows)
            if (const std::optional<ImagePolygon::Interval> inside = shadow.onLine(y_)) onLine.push_back(*inside);
        std::ranges::sort(onLine, {}, &ImagePolygon::Interval::from);
        return onLine;
    }

    const std::vector<Patch>& patches_;
    double y_ = 0;
    Lengths lengths_;
    std::vector<Span> spans_;
    std::vector<double> cuts_;
    std::vector<const Span*> behindOneAnother_;
    std::vector<Shadows> shadows_; // by patch
};

void addEdges(const ImagePolygon& polygon, std::vector<PatchEdge>& edges) {
    const Corners<glm::dvec2>& corners = polygon.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back({corners[i], corners.after(i)});
}

/// All edges at whose corners and crossings lengths along a line can begin to change in another way.
std::vector<PatchEdge> edgesOf(const std::vector<Patch>& patches) {
    std::vector<PatchEdge> edges;
    for (const Patch& patch : patches) {
        addEdges(patch.outline, edges);
        for (const ImagePolygon& shadow : patch.shadows) addEdges(shadow, edges);
    }
    return edges;
}

/// Height at which two edges cross.
std::optional<double> crossingHeight(const PatchEdge& a, const PatchEdge& b) {
    const glm::dvec2 d = a.to - a.from, e = b.to - b.from, between = b.from - a.from;
    const double turn = d.x * e.y - d.y * e.x, sign = turn < 0 ? -1 : 1, whole = sign * turn;
    if (turn == 0) return std::nullopt;
    const double alongA = sign * (between.x * e.y - between.y * e.x), alongB = sign * (between.x * d.y - between.y * d.x);
    if (std::min(alongA, alongB) < 0 || std::max(alongA, alongB) > whole) return std::nullopt;
    return a.from.y + alongA / whole * d.y;
}

/// The heights of all corners; between them and the crossings of edges lengths change linearly.
std::vector<double> cornerHeights(const std::vector<PatchEdge>& edges, const ImageRectangle& square) {
    std::vector<double> heights{square.low.y, square.high.y};
    if (edges.size() >= manyEdges) return heights;
    for (const PatchEdge& edge : edges) heights.push_back(edge.from.y);
    return heights;
}

void addCrossings(const std::vector<PatchEdge>& edges, std::vector<double>& heights) {
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (const std::optional<double> y = crossingHeight(edges[i], edges[j])) heights.push_back(*y);
}

/// Sums over lines; the uncertainty that comes of their number.
class Sum {
public:
    /// Lines through the middles of `count` equal parts of [from, to].
    void addLines(LineReader& reader, double from, double to, int count) {
        const double height = (to - from) / count;
        Lengths last;
        for (int i = 0; i < count; ++i) {
            const Lengths here = reader.at(from + (i + 0.5) * height);
            shares_.seen += height * here.seen;
            shares_.lit += height * here.lit;
            if (i > 0) steps_.push_back({height * (here.seen - last.seen), height * (here.lit - last.lit), false});
            last = here;
        }
    }

    /// A strip that one line through its middle gives exactly, or several where patches cross.
    void addExactStrip(LineReader& reader, double from, double to, int lines) {
        const Lengths middle = reader.at(0.5 * (from + to));
        if (middle.crossing) return addStrip(reader, from, to, lines);
        shares_.seen += (to - from) * middle.seen;
        shares_.lit += (to - from) * middle.lit;
    }

    /// A strip in which edges may cross; `lines` would cross all of the pixel.
    void addStrip(LineReader& reader, double from, double to, int lines) {
        addLines(reader, from, to, std::max(2, static_cast<int>(std::ceil(lines * (to - from)))));
    }

    /// Lines that agree on all or nothing may all have missed a sliver. The one through the pixel's centre, whose label the
    /// mean must not contradict, then counts as one of `lines` more.
    void addCentreIfUnanimous(LineReader& reader, double centre, int lines) {
        const double share = shares_.lit / shares_.seen;
        if (share > rounding && share < 1 - rounding) return;
        const Lengths here = reader.at(centre);
        const double height = 1.0 / lines;
        shares_.seen += height * here.seen;
        shares_.lit += height * here.lit;
        steps_.insert(steps_.end(), 2, {height * here.seen, height * here.lit, false}); // from a line and to the next
    }

    /// Two neighbouring lines differ by at most twice what one may err by: with s a step of lit − mean · seen, the variance
    /// of a sum over lines is at most ½ Σ s².
    [[nodiscard]] AreaShares result() const {
        AreaShares result = shares_;
        if (result.seen <= 0) return result;
        const double mean = result.lit / result.seen;
        double squares = 0;
        for (const Lengths& step : steps_) {
            const double change = step.lit - mean * step.seen;
            squares += change * change;
        }
        result.sigma = std::sqrt(0.5 * squares) / result.seen;
        return result;
    }

private:
    AreaShares shares_;
    std::vector<Lengths> steps_; // from line to line, times the height of a line's strip
};

template <class AddStrip>
Sum overStrips(const std::vector<double>& heights, const AddStrip& add) {
    Sum sum;
    for (std::size_t i = 1; i < heights.size(); ++i)
        if (heights[i] - heights[i - 1] > leastStrip) add(sum, heights[i - 1], heights[i]);
    return sum;
}

/// Most pixels: all that they see counts, and is lit, or is in shadow.
std::optional<AreaShares> sharesIfAlike(const std::vector<Patch>& patches) {
    double largest = 0;
    for (const Patch& patch : patches) {
        const bool whole = patch.shadowed || patch.shadows.empty();
        if (!patch.counts || !whole || patch.shadowed != patches.front().shadowed) return std::nullopt;
        largest = std::max(largest, patch.outline.area());
    }
    if (largest < surelySeen) return std::nullopt;
    return AreaShares{largest, patches.front().shadowed ? 0 : largest, 0};
}

} // namespace

AreaShares shares(const std::vector<Patch>& patches, const ImageRectangle& square) {
    if (const std::optional<AreaShares> alike = sharesIfAlike(patches)) return *alike;
    LineReader reader(patches);
    const std::vector<PatchEdge> edges = edgesOf(patches);
    std::vector<double> heights = cornerHeights(edges, square);
    const bool exact = edges.size() <= fewEdges;
    if (exact) addCrossings(edges, heights);
    std::ranges::sort(heights);
    for (int lines = fewestLines;; lines *= 4) {
        Sum sum = overStrips(heights, [&](Sum& all, double from, double to) {
            exact ? all.addExactStrip(reader, from, to, lines) : all.addStrip(reader, from, to, lines);
        });
        if (!exact) sum.addCentreIfUnanimous(reader, square.low.y + 0.5, lines);
        const AreaShares result = sum.result();
        if (result.sigma <= largestSigma || lines >= mostLines) return result;
    }
}

} // namespace shadowbench::groundtruth::hard
