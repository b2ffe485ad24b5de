#include "groundtruth/cgal/area/area_weights.h"

#include "groundtruth/cgal/area/area_double_double.h"
#include "groundtruth/cgal/area/area_light_map.h"
#include "groundtruth/cgal/area/area_slabs.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace shadowbench::groundtruth::area {
namespace {

/// Of the whole irradiance: what rounding may add to one part that Lambert's sum gives.
constexpr double roundingError = 0x1p-46;

/// On [0, 1].
struct Node {
    double at, weight;
};

template <unsigned Count>
std::array<Node, Count> nodes() {
    using Rule = boost::math::quadrature::gauss<double, Count>;
    const auto& abscissa = Rule::abscissa(); // not negative ones
    const auto& weights = Rule::weights();
    std::array<Node, Count> result{};
    const std::size_t half = abscissa.size();
    for (std::size_t i = 0; i < half; ++i) {
        result[half - 1 - i] = {0.5 - 0.5 * abscissa[i], 0.5 * weights[i]};
        result[Count - half + i] = {0.5 + 0.5 * abscissa[i], 0.5 * weights[i]};
    }
    return result;
}

std::span<const Node> nodes(int count) {
    static const std::array<Node, 3> three = nodes<3>();
    static const std::array<Node, 5> five = nodes<5>();
    static const std::array<Node, 7> seven = nodes<7>();
    static const std::array<Node, 10> ten = nodes<10>();
    if (count == 3) return three;
    if (count == 5) return five;
    if (count == 7) return seven;
    return ten;
}

/// How many nodes leave an error of the order of the rounding on a segment whose integrand, a polynomial of the second
/// degree times r⁻⁴, has its poles `reach` half-lengths away from the segment's middle: with ρ = reach + √(reach² − 1), the
/// error falls with ρ^(2 − 2n). 0 where the poles are too near for the largest rule.
int nodesFor(double reach) {
    if (reach >= 8400) return 3;
    if (reach >= 66) return 5;
    if (reach >= 13) return 7;
    return reach >= 4.4 ? 10 : 0;
}

double rounded(const DoubleDouble& value) { return value.high + value.low; }

glm::dvec3 rounded(const Vector<DoubleDouble>& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

/// The surface point in double-double numbers.
Vector<DoubleDouble> positionOf(const SurfacePoint& point) {
    const auto corner = vector<DoubleDouble>(point.receiver[0]), across = normal<DoubleDouble>(point.receiver);
    const auto origin = vector<DoubleDouble>(point.ray.origin), direction = vector<DoubleDouble>(point.ray.direction);
    return origin + dot(across, corner - origin) / dot(across, direction) * direction;
}

/// By the tangent of half the solid angle; the determinant of a, b and c is known better than from them.
double triangleSolidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double determinant) {
    if (!(determinant > 0)) return 0;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::atan2(determinant, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

} // namespace

LightWeights::LightWeights(const Light& light, const SurfacePoint& point) {
    const Vector<DoubleDouble> position = positionOf(point), none = vector<DoubleDouble>(glm::dvec3(0));
    const LightMap<DoubleDouble> map(position, none, light, 1);
    const glm::dvec3 towards = rounded(map.offset(light.centre));
    const glm::dvec3 across = rounded(cross(vector<DoubleDouble>(light.u), vector<DoubleDouble>(light.v)));
    const double parallelogram = glm::length(across);
    side_ = glm::length(light.u);
    distance_ = std::abs(rounded(map.distance)) / parallelogram;

    const glm::dvec3 along = light.u / side_;
    const glm::dvec3 away = (rounded(map.distance) < 0 ? -1 : 1) / parallelogram * across;
    const glm::dvec3 sideways = glm::cross(away, along);
    centre_ = {glm::dot(towards, along), glm::dot(towards, sideways)};
    slope_ = {glm::dot(light.v, along), glm::dot(light.v, sideways)};

    // Heights above the tangent plane do not depend on where in it the point lies.
    const Vector<DoubleDouble> receiver = normal<DoubleDouble>(point.receiver);
    const auto height = [&](const Vector<DoubleDouble>& v) { return rounded(dot(receiver, v)); };
    heights_ = {height(vector<DoubleDouble>(light.u)), height(vector<DoubleDouble>(light.v)),
                height(vector<DoubleDouble>(light.centre) - vector<DoubleDouble>(point.receiver[0]))};
    const glm::dvec3 plain = rounded(receiver);
    const double scale = (heights_.z < 0 ? -1 : 1) / glm::length(plain);
    heights_ *= scale;
    normal_ = scale * glm::dvec3(glm::dot(plain, along), glm::dot(plain, sideways), glm::dot(plain, away));

    const LightPart square{-0.5, 0.5, -0.5, 0.5, -0.5, 0.5};
    whole_ = irradiance(square);
    wholeSolidAngle_ = solidAngle(square);
}

glm::dvec2 LightWeights::placed(double x, double y) const {
    return {centre_.x + x * side_ + y * slope_.x, centre_.y + y * slope_.y};
}

LightWeights::Bounded LightWeights::lambert(const LightPart& part) const {
    const std::array corners{placed(part.lowLeft, part.low), placed(part.lowRight, part.low),
                             placed(part.highRight, part.high), placed(part.highLeft, part.high)};
    Bounded sum{0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i], step = corners[(i + 1) % 4] - a;
        const glm::dvec3 from(a, distance_), to(a + step, distance_);
        const glm::dvec3 across(-distance_ * step.y, distance_ * step.x, a.x * step.y - a.y * step.x); // from × to
        const double sine = glm::length(across);
        if (sine == 0) continue; // no edge
        const double ratio = std::atan2(sine, glm::dot(from, to)) / sine;
        sum.value += 0.5 * ratio * glm::dot(normal_, across);
        sum.error += 8 * unit * ratio * glm::length(from) * glm::length(to);
    }
    if (slope_.y < 0) sum.value = -sum.value; // the corners run clockwise
    return {std::max(sum.value, 0.0), sum.error};
}

double LightWeights::quadrature(const LightPart& part, int across, int upwards) const {
    double sum = 0;
    for (const Node& row : nodes(upwards)) {
        const double y = part.low + row.at * (part.high - part.low);
        const double left = part.lowLeft + row.at * (part.highLeft - part.lowLeft);
        const double right = part.lowRight + row.at * (part.highRight - part.lowRight);
        const glm::dvec2 start = placed(0, y);
        const double rest = start.y * start.y + distance_ * distance_, height = heights_.z + y * heights_.y;
        double line = 0;
        for (const Node& node : nodes(across)) {
            const double x = left + node.at * (right - left), p = start.x + x * side_;
            const double square = p * p + rest;
            line += node.weight * (height + x * heights_.x) / (square * square);
        }
        sum += row.weight * (right - left) * line;
    }
    return std::max(sum, 0.0) * distance_ * (part.high - part.low) * side_ * std::abs(slope_.y);
}

double LightWeights::irradiance(const LightPart& part, int cuts) const {
    const double middle = 0.5 * (part.low + part.high);
    const double middleLeft = 0.5 * (part.lowLeft + part.highLeft), middleRight = 0.5 * (part.lowRight + part.highRight);
    const double width = 0.5 * side_ * std::max(part.lowRight - part.lowLeft, part.highRight - part.highLeft);
    const double height = 0.5 * std::max(glm::distance(placed(part.lowLeft, part.low), placed(part.highLeft, part.high)),
                                         glm::distance(placed(part.lowRight, part.low), placed(part.highRight, part.high)));
    const double away = glm::length(glm::dvec3(placed(0.5 * (middleLeft + middleRight), middle), distance_));
    const int across = nodesFor((away - height) / width), upwards = nodesFor((away - width) / height);
    if (across > 0 && upwards > 0) return quadrature(part, across, upwards);

    const Bounded closed = lambert(part);
    if (cuts == 0 || closed.error <= roundingError * std::max(whole_, closed.value)) return closed.value;
    if (height > width)
        return irradiance({part.low, middle, part.lowLeft, part.lowRight, middleLeft, middleRight}, cuts - 1) +
               irradiance({middle, part.high, middleLeft, middleRight, part.highLeft, part.highRight}, cuts - 1);
    const double low = 0.5 * (part.lowLeft + part.lowRight), high = 0.5 * (part.highLeft + part.highRight);
    return irradiance({part.low, part.high, part.lowLeft, low, part.highLeft, high}, cuts - 1) +
           irradiance({part.low, part.high, low, part.lowRight, high, part.highRight}, cuts - 1);
}

double LightWeights::solidAngle(const LightPart& part) const {
    const glm::dvec3 a(placed(part.lowLeft, part.low), distance_), b(placed(part.lowRight, part.low), distance_),
        c(placed(part.highRight, part.high), distance_), d(placed(part.highLeft, part.high), distance_);
    const double twice = distance_ * (part.high - part.low) * side_ * std::abs(slope_.y); // determinant over the width
    return triangleSolidAngle(a, b, c, (part.lowRight - part.lowLeft) * twice) +
           triangleSolidAngle(a, c, d, (part.highRight - part.highLeft) * twice);
}

double LightWeights::leastDistance() const {
    const double y = -centre_.y / slope_.y, x = -(centre_.x + y * slope_.x) / side_; // the foot in light coordinates
    const double beside = (std::abs(x) - 0.5) * side_ * std::abs(slope_.y) / glm::length(slope_);
    const double beyond = (std::abs(y) - 0.5) * std::abs(slope_.y);
    return std::hypot(distance_, std::max({beside, beyond, 0.0}));
}

double LightWeights::densest(Share share) const {
    const double area = side_ * std::abs(slope_.y), nearest = leastDistance();
    const double solidAngle = distance_ * area / (nearest * nearest * nearest);
    if (share == Share::SolidAngle) return solidAngle / wholeSolidAngle_;
    const double highest = heights_.z + 0.5 * (std::abs(heights_.x) + std::abs(heights_.y));
    return solidAngle * highest / (nearest * whole_);
}

namespace {

/// In which parts of the light a gap between two edges lies.
struct Place {
    bool inner = false, outer = false, hidden = false;
    friend bool operator==(const Place&, const Place&) = default;
};

Place placeOf(const Change& now) { return {now.inner > 0, now.outer > 0, now.covers > 0}; }

/// What lies between two edges in a row. Rounding may exchange edges that meet there.
LightPart between(const UpwardEdge& left, const UpwardEdge& right, const Row& row) {
    const double height = row.top - row.bottom;
    const auto at = [](const UpwardEdge& edge, double share) { return edge.bottom + share * (edge.top - edge.bottom); };
    LightPart part{row.bottom + row.from * height,
                   row.bottom + row.to * height,
                   at(left, row.from),
                   at(right, row.from),
                   at(left, row.to),
                   at(right, row.to)};
    part.lowRight = std::max(part.lowLeft, part.lowRight);
    part.highRight = std::max(part.highLeft, part.highRight);
    return part;
}

/// Calls `visit(place, part)` for the parts of the row that lie in the light's shape, neighbours in one place as one.
template <typename Visit>
void visitParts(const Row& row, const Visit& visit) {
    Change now;
    const UpwardEdge* left = nullptr; // where the part begins
    Place place;
    for (const UpwardEdge* edge : row.edges) {
        now = {now.covers + edge->change.covers, now.inner + edge->change.inner, now.outer + edge->change.outer};
        const Place next = placeOf(now);
        if (next == place) continue;
        if (left != nullptr && (place.inner || place.outer)) visit(place, between(*left, *edge, row));
        left = edge;
        place = next;
    }
}

} // namespace

VisibleFraction weighedFraction(const std::vector<CoverEdge>& edges, const LightShape& shape, const LightWeights& weights,
                                Share share) {
    LightAreas sums{};
    Sweep(upwardEdges(edges, shape)).visitRows([&](const Row& row) {
        visitParts(row, [&](const Place& place, const LightPart& part) {
            if (!(part.lowRight > part.lowLeft) && !(part.highRight > part.highLeft)) return;
            const double weight = weights.of(share, part);
            if (place.inner) (place.hidden ? sums.innerHidden : sums.innerVisible) += weight;
            if (place.outer) (place.hidden ? sums.outerHidden : sums.outerVisible) += weight;
        });
    });
    const double low = sums.innerVisible / (sums.innerVisible + sums.outerHidden);
    const double high = sums.outerVisible / (sums.outerVisible + sums.innerHidden);
    return {low, high};
}

} // namespace shadowbench::groundtruth::area
