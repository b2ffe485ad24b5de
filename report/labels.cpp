#include "report/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <numeric>

namespace shadowbench::report {
namespace {

constexpr double pointRadius = 7;   // pixels kept free around a point
constexpr double nearest = 10;      // pixels between a point and its label where there is room
constexpr double crossedLine = 90;  // as bad as so many pixels of distance
constexpr double crossedLeader = 8; // by a leader or a mark that a leader runs over

/// Sides of the point on which a label may lie, right and down; the first is taken where all are as good.
constexpr double right = 0, left = 180, above = 270, below = 90;
constexpr double angles[] = {right, left, above, below, 315,   45,   225,   135,
                             337.5, 22.5, 202.5, 157.5, 292.5, 67.5, 247.5, 112.5};

/// Advance widths of the letters from U+0020 to U+007E, thousandths of the size: of Helvetica, whose metrics Liberation
/// Sans and Arial have.
constexpr std::array<int, 95> letterWidths{
    278, 278, 355, 556, 556, 889, 667, 191, 333,  333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667,  667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556,
    556, 222, 222, 500, 222, 833, 556, 556, 556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};

struct Segment {
    glm::dvec2 from, to;
};

/// Whether the part of the segment that `low` and `high` bound along one axis is any; narrows [first, last].
bool clip(double from, double step, double low, double high, double& first, double& last) {
    if (step == 0) return from > low && from < high;
    const auto [a, b] = std::minmax({(low - from) / step, (high - from) / step});
    first = std::max(first, a);
    last = std::min(last, b);
    return first < last;
}

bool crosses(const Box& box, const Segment& segment) {
    double first = 0, last = 1;
    const glm::dvec2 step = segment.to - segment.from;
    return clip(segment.from.x, step.x, box.low.x, box.high.x, first, last) &&
           clip(segment.from.y, step.y, box.low.y, box.high.y, first, last);
}

bool crosses(const Segment& a, const Segment& b) {
    const auto side = [](glm::dvec2 p, glm::dvec2 q, glm::dvec2 r) {
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    return side(a.from, a.to, b.from) * side(a.from, a.to, b.to) < 0 &&
           side(b.from, b.to, a.from) * side(b.from, b.to, a.to) < 0;
}

PlacedLabel candidate(const LabelledPoint& point, double angle, double distance) {
    const double turn = angle * std::numbers::pi / 180;
    const glm::dvec2 way(std::cos(turn), std::sin(turn));
    const auto side = [](double share) { return share > 0.3 ? 1 : share < -0.3 ? -1 : 0; };
    const glm::ivec2 at(side(way.x), side(way.y));
    const glm::dvec2 centre = point.at + distance * way + 0.5 * glm::dvec2(at) * point.size;
    return {{centre - 0.5 * point.size, centre + 0.5 * point.size}, at, distance > nearest};
}

Box around(glm::dvec2 point) { return {point - pointRadius, point + pointRadius}; }

/// Places one label after another, each off those before.
class Placing {
public:
    explicit Placing(const Surroundings& around) : around_(around) {}

    std::optional<PlacedLabel> place(const LabelledPoint& point) {
        std::optional<PlacedLabel> best;
        double least = std::numeric_limits<double>::infinity();
        for (const double distance : {nearest, 18.0, 28.0, 40.0, 55.0, 75.0, 100.0, 130.0, 165.0, 205.0, 250.0, 300.0})
            for (const double angle : angles) {
                const PlacedLabel label = candidate(point, angle, distance);
                if (!isFree(label, point)) continue;
                const double worth = distance + penalty(label, point);
                if (worth >= least) continue;
                least = worth;
                best = label;
            }
        if (!best) return best;
        boxes_.push_back(best->box);
        if (best->leader) leaders_.push_back({point.at, best->box.closest(point.at)});
        return best;
    }

private:
    [[nodiscard]] bool isFree(const PlacedLabel& label, const LabelledPoint& point) const {
        const auto overlaps = [&](const Box& box) { return label.box.overlaps(box); };
        if (!around_.area.contains(label.box) || std::ranges::any_of(around_.taken, overlaps) ||
            std::ranges::any_of(boxes_, overlaps))
            return false;
        if (std::ranges::any_of(around_.marks, [&](glm::dvec2 mark) { return overlaps(around(mark)); })) return false;
        if (std::ranges::any_of(leaders_, [&](const Segment& leader) { return crosses(label.box, leader); })) return false;
        const Segment own{point.at, label.box.closest(point.at)};
        const auto isCrossed = [&](const Box& box) { return label.leader && crosses(box, own); };
        return std::ranges::none_of(boxes_, isCrossed) && std::ranges::none_of(around_.taken, isCrossed);
    }

    [[nodiscard]] double penalty(const PlacedLabel& label, const LabelledPoint& point) const {
        double sum = 0;
        const Segment own{point.at, label.box.closest(point.at)};
        for (const auto& [a, b] : around_.lines) sum += crosses(label.box, {a, b}) ? crossedLine : 0;
        if (!label.leader) return sum;
        for (const Segment& leader : leaders_) sum += crosses(leader, own) ? crossedLeader : 0;
        for (const glm::dvec2 mark : around_.marks)
            sum += mark != point.at && crosses(around(mark), own) ? crossedLeader : 0;
        return sum;
    }

    const Surroundings& around_;
    std::vector<Box> boxes_;
    std::vector<Segment> leaders_;
};

/// Heights in the order of the wanted ones, `step` apart at least, from `low` to `high`: what is left of a wanted height
/// when the steps before it are taken away must not fall, so neighbours that would fall take their mean (isotonic
/// regression).
std::vector<double> spread(const std::vector<double>& wanted, double step, double low, double high) {
    struct Level {
        double sum;
        int count;
        [[nodiscard]] double mean() const { return sum / count; }
    };
    std::vector<Level> levels;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        Level last{wanted[i] - step * static_cast<double>(i), 1};
        for (; !levels.empty() && levels.back().mean() > last.mean(); levels.pop_back())
            last = {last.sum + levels.back().sum, last.count + levels.back().count};
        levels.push_back(last);
    }
    const double highest = high - step * (static_cast<double>(wanted.size()) - 1);
    std::vector<double> result;
    for (const Level& level : levels)
        for (int i = 0; i < level.count; ++i)
            result.push_back(std::clamp(level.mean(), low, std::max(low, highest)) +
                             step * static_cast<double>(result.size()));
    return result;
}

} // namespace

glm::dvec2 Box::closest(glm::dvec2 point) const { return glm::clamp(point, low, high); }

bool Box::overlaps(const Box& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
}

bool Box::contains(const Box& other) const {
    return low.x <= other.low.x && low.y <= other.low.y && high.x >= other.high.x && high.y >= other.high.y;
}

double textWidth(const std::string& text, double size) {
    int thousandths = 0;
    for (const char letter : text) {
        const auto code = static_cast<unsigned char>(letter);
        if ((code & 0xC0U) == 0x80U) continue; // not the first byte of its character
        thousandths += code >= 0x20 && code < 0x7F ? letterWidths[code - 0x20U] : 1000;
    }
    return size * thousandths / 1000;
}

LabelledPoint labelled(glm::dvec2 at, const std::string& text) {
    return {at, text, {textWidth(text, labelSize) + 2, lineHeight}};
}

std::vector<std::optional<PlacedLabel>> placeLabels(const std::vector<LabelledPoint>& points, const Surroundings& around) {
    Placing placing(around);
    std::vector<std::optional<PlacedLabel>> placed;
    placed.reserve(points.size());
    for (const LabelledPoint& point : points) placed.push_back(placing.place(point));
    return placed;
}

std::vector<PlacedLabel> placeInColumn(const std::vector<LabelledPoint>& points, const Box& area) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return points[i].at.y; });
    std::vector<double> wanted;
    wanted.reserve(order.size());
    for (const std::size_t i : order) wanted.push_back(points[i].at.y);
    const double step =
        std::min(lineHeight, (area.high.y - area.low.y) / static_cast<double>(std::max<std::size_t>(1, order.size())));
    const std::vector<double> heights = spread(wanted, step, area.low.y + 0.5 * step, area.high.y - 0.5 * step);
    std::vector<PlacedLabel> placed(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const LabelledPoint& point = points[order[k]];
        const double wide = point.size.x;
        placed[order[k]] = {
            {{area.low.x, heights[k] - 0.5 * step}, {area.low.x + wide, heights[k] + 0.5 * step}}, {1, 0}, true};
    }
    return placed;
}

} // namespace shadowbench::report
