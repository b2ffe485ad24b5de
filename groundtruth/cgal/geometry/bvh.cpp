// Construction by the binned surface-area heuristic (Wald 2007), two levels of the binary tree in a node.
#include "groundtruth/cgal/geometry/bvh.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace shadowbench::groundtruth::geometry {
namespace {

constexpr int binCount = 16;
constexpr std::uint32_t leafSize = 4;
constexpr int balancedBelow = 64; // depth from which ranges are halved by count, to bound the depth of the tree
constexpr std::uint32_t worthAThread = 1U << 14U; // primitives

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FloatBox emptyBox{glm::vec3(infinity), glm::vec3(-infinity)};

void add(FloatBox& box, const FloatBox& other) {
    box.low = glm::min(box.low, other.low);
    box.high = glm::max(box.high, other.high);
}

float halfArea(const FloatBox& box) {
    const glm::vec3 size = box.high - box.low;
    return size.x < 0 ? 0 : size.x * size.y + size.y * size.z + size.z * size.x;
}

int widest(const FloatBox& box) {
    const glm::vec3 size = box.high - box.low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

double largest(const glm::dvec3& v) { return glm::max(v.x, glm::max(v.y, v.z)); }

} // namespace

Bvh::FloatSegment::FloatSegment(const PaddedSegment& segment, const FloatBox& bounds) {
    constexpr double huge = 1e30, tiny = 1e-30;
    const glm::dvec3 coordinates = glm::max(glm::abs(glm::dvec3(bounds.low)), glm::abs(glm::dvec3(bounds.high)));
    const glm::dvec3 reach = glm::abs(segment.from) + glm::abs(segment.to) + coordinates;
    // Twice what `entries` and the conversions here can be wrong by, eight roundings of half a unit in the last place.
    const glm::dvec3 pad = segment.pad + 16 * 0x1p-24 * largest(reach);
    // Where floats end, no box is told from another: with an inverse of 0 the segment meets all of them at once.
    const bool fits = largest(reach + pad) < huge && largest(reach) > 1e10 * tiny;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = segment.to[axis] - segment.from[axis];
        // A component too small to divide by moves the segment by less than the pad.
        const double divisor = std::abs(step) < tiny ? tiny : step;
        low_[axis] = all(fits ? static_cast<float>(segment.from[axis] + pad[axis]) : 0);
        high_[axis] = all(fits ? static_cast<float>(segment.from[axis] - pad[axis]) : 0);
        inverse_[axis] = all(fits ? 1 / static_cast<float>(divisor) : 0);
    }
}

bool mayMeet(const PaddedSegment& segment, const FloatBox& box) {
    double enter = 0, leave = segment.last;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = segment.from[axis], step = segment.to[axis] - from, pad = segment.pad[axis];
        const double low = box.low[axis] - (from + pad), high = box.high[axis] - (from - pad);
        if (std::abs(step) < 1e-290) { // it moves by less than any pad
            if (low > 0 || high < 0) return false;
            continue;
        }
        const double a = low / step, b = high / step;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

class Bvh::Builder {
public:
    Builder(Bvh& tree, const std::vector<FloatBox>& boxes) : tree_(tree) {
        entries_.reserve(boxes.size());
        for (std::uint32_t i = 0; i < boxes.size(); ++i) entries_.push_back({boxes[i], i});
        Range whole{0, static_cast<std::uint32_t>(boxes.size()), 0, {}, {}};
        measure(whole);
        tree_.bounds_ = whole.box;
        tree_.root_ = build(whole, tree_.nodes_, availableThreads());
        tree_.order_.reserve(entries_.size());
        for (const Entry& entry : entries_) tree_.order_.push_back(entry.primitive);
    }

private:
    struct Entry {
        FloatBox box;
        std::uint32_t primitive;

        [[nodiscard]] float centre(int axis) const { return 0.5F * box.low[axis] + 0.5F * box.high[axis]; }
    };

    struct Range {
        std::uint32_t first, last;
        int depth;
        FloatBox box, centres;
        [[nodiscard]] std::uint32_t count() const { return last - first; }
        [[nodiscard]] bool isLeaf() const { return count() <= leafSize; }
    };

    void measure(Range& range) const {
        range.box = range.centres = emptyBox;
        for (std::uint32_t i = range.first; i < range.last; ++i) {
            const Entry& entry = entries_[i];
            const glm::vec3 c(entry.centre(0), entry.centre(1), entry.centre(2));
            add(range.box, entry.box);
            add(range.centres, {c, c});
        }
    }

    /// Each thread writes nodes of its own, which are then joined.
    Part build(const Range& range, std::vector<Node>& nodes, int threads) {
        if (range.isLeaf()) return {range.first, range.count()};
        std::array<Range, 4> children;
        std::uint32_t count = 0;
        for (const Range& half : halves(range)) {
            if (half.isLeaf())
                children[count++] = half;
            else
                for (const Range& quarter : halves(half)) children[count++] = quarter;
        }
        Node node{};
        node.children = count;
        for (std::uint32_t child = 0; child < count; ++child)
            for (int axis = 0; axis < 3; ++axis) {
                node.boxes.low[axis][child] = children[child].box.low[axis];
                node.boxes.high[axis][child] = children[child].box.high[axis];
            }
        const auto index = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node);
        if (threads > 1 && range.count() > worthAThread) {
            std::array<std::vector<Node>, 4> own;
            std::array<Part, 4> parts;
            inParallel(static_cast<int>(count), threads,
                       [&](int child) { parts[child] = build(children[child], own[child], threads / 4); });
            for (std::uint32_t child = 0; child < count; ++child)
                nodes[index].parts[child] = join(own[child], parts[child], nodes);
        } else {
            for (std::uint32_t child = 0; child < count; ++child) {
                const Part part = build(children[child], nodes, 1);
                nodes[index].parts[child] = part;
            }
        }
        return {index, 0};
    }

    /// Appends `part` of `own` to `nodes`, and returns what it is there.
    static Part join(const std::vector<Node>& own, Part part, std::vector<Node>& nodes) {
        const auto offset = static_cast<std::uint32_t>(nodes.size());
        const auto moved = [&](Part p) { return Part{p.first + (p.count == 0 ? offset : 0), p.count}; };
        for (Node node : own) {
            for (std::uint32_t child = 0; child < node.children; ++child) node.parts[child] = moved(node.parts[child]);
            nodes.push_back(node);
        }
        return moved(part);
    }

    std::array<Range, 2> halves(const Range& range) {
        const std::uint32_t middle = range.depth < balancedBelow ? split(range) : halve(range);
        std::array<Range, 2> result{Range{range.first, middle, range.depth + 1, {}, {}},
                                    Range{middle, range.last, range.depth + 1, {}, {}}};
        for (Range& half : result) measure(half);
        return result;
    }

    /// Cheapest of the bin borders on the widest axis; halves by count where binning cannot separate anything.
    std::uint32_t split(const Range& range) {
        const int axis = widest(range.centres);
        const float low = range.centres.low[axis], extent = range.centres.high[axis] - low;
        if (!(extent > 0)) return halve(range);

        const auto binOf = [&](const Entry& entry) {
            return std::min(binCount - 1, static_cast<int>((entry.centre(axis) - low) / extent * binCount));
        };
        std::array<FloatBox, binCount> box;
        std::array<std::uint32_t, binCount> count{};
        box.fill(emptyBox);
        for (std::uint32_t i = range.first; i < range.last; ++i) {
            const int bin = binOf(entries_[i]);
            add(box[bin], entries_[i].box);
            ++count[bin];
        }

        const int border = cheapestBorder(box, count);
        if (border == 0) return halve(range);
        const auto middle = std::partition(entries_.begin() + range.first, entries_.begin() + range.last,
                                           [&](const Entry& entry) { return binOf(entry) < border; });
        return static_cast<std::uint32_t>(middle - entries_.begin());
    }

    static int cheapestBorder(const std::array<FloatBox, binCount>& box, const std::array<std::uint32_t, binCount>& count) {
        std::array<float, binCount> right{}; // cost of everything from a bin on
        FloatBox sum = emptyBox;
        std::uint32_t total = 0;
        for (int bin = binCount - 1; bin > 0; --bin) {
            add(sum, box[bin]);
            total += count[bin];
            right[bin] = halfArea(sum) * static_cast<float>(total);
        }
        const std::uint32_t all = total + count[0];
        int best = 0;
        float lowest = infinity;
        sum = emptyBox;
        total = 0;
        for (int border = 1; border < binCount; ++border) {
            add(sum, box[border - 1]);
            total += count[border - 1];
            const float cost = halfArea(sum) * static_cast<float>(total) + right[border];
            if (total == 0 || total == all || cost >= lowest) continue;
            lowest = cost;
            best = border;
        }
        return best;
    }

    std::uint32_t halve(const Range& range) {
        const int axis = widest(range.centres);
        const std::uint32_t middle = range.first + range.count() / 2;
        std::nth_element(entries_.begin() + range.first, entries_.begin() + middle, entries_.begin() + range.last,
                         [&](const Entry& a, const Entry& b) { return a.centre(axis) < b.centre(axis); });
        return middle;
    }

    Bvh& tree_;
    std::vector<Entry> entries_;
};

Bvh::Bvh(const std::vector<FloatBox>& boxes) {
    if (!boxes.empty()) Builder(*this, boxes);
}

} // namespace shadowbench::groundtruth::geometry
