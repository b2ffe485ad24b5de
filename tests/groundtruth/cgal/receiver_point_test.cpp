#include "base/random.h"
#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/winding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::geometry {
namespace {

glm::dvec3 somewhere(Random& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// Whether what is near the point to within its error can be the point.
void expectNear(const ReceiverPoint& point) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(point.near()[axis] + point.nearError()[axis], point.low()[axis]);
        EXPECT_LE(point.near()[axis] - point.nearError()[axis], point.high()[axis]);
    }
}

TEST(ReceiverPoint, IsNoFartherFromItsRoundedPointThanTheError) {
    Random random(1);
    for (int round = 0; round < 20'000; ++round) {
        const double reach = std::pow(10.0, random.uniform(-6, 6));
        const Triangle triangle{somewhere(random, reach), somewhere(random, reach), somewhere(random, reach)};
        const glm::dvec3 origin = somewhere(random, reach);
        // Towards the triangle, but for one round in four, in which it is nearly in the plane.
        const glm::dvec3 towards = random.uniform() * triangle[0] + random.uniform() * triangle[1];
        const double lift = round % 4 == 0 ? 1e-14 : 1;
        const glm::dvec3 direction = lift * (towards - origin) + (1 - lift) * (triangle[1] - triangle[0]);
        const ReceiverPoint point({origin, direction}, triangle);
        expectNear(point);
        if (round % 4 != 0) { // far above rounding, for some of these triangles are slivers
            EXPECT_LT(glm::length(point.nearError()), 1e-6 * (reach + glm::length(point.near())));
        }
    }
}

TEST(ReceiverPoint, IsExactlyThereWhereNothingIsRounded) {
    const Triangle ground{glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 8), glm::dvec3(8, 0, 0)};
    const ReceiverPoint point({{1, 4, 1}, {0.25, -1, 0.5}}, ground);
    EXPECT_EQ(point.low(), glm::dvec3(2, 0, 3));
    EXPECT_EQ(point.high(), glm::dvec3(2, 0, 3));
    expectNear(point);
    EXPECT_EQ(side(ground, point), 0);
}

TEST(Blocking, OfPointsBesideAnEdgeIsThatOfTheEdgesSide) {
    // The light's shadow of the edge x = 1 at height 1 lies at x = 2 of the ground, to the bit.
    const Triangle ground{glm::dvec3(-9, 0, -9), glm::dvec3(-9, 0, 9), glm::dvec3(9, 0, 0)};
    const Triangle blocker{glm::dvec3(1, 1, -4), glm::dvec3(1, 1, 4), glm::dvec3(-3, 1, 0)};
    const glm::dvec4 light(0, 2, 0, 1);
    const auto blocked = [&](double x) {
        const ReceiverPoint point({{x, 1, 0}, {0, -1, 0}}, ground);
        return blocking(point, light, blocker);
    };
    EXPECT_EQ(blocked(2), Blocking::Touches);
    EXPECT_EQ(blocked(std::nextafter(2.0, 0)), Blocking::Blocks);
    EXPECT_EQ(blocked(std::nextafter(2.0, 3)), Blocking::None);
    EXPECT_EQ(blocked(1.9), Blocking::Blocks);
    EXPECT_EQ(blocked(2.1), Blocking::None);
}

/// A multiple of 1/1024.
glm::dvec3 dyadic(Random& random, double reach) { return glm::round(1024.0 * somewhere(random, reach)) / 1024.0; }

/// Calls `test` with points that rays meet at `exact` to the bit, a third of the way on, in planes that some of them nearly
/// lie in: there rounded arithmetic knows the point to some digits only.
template <typename Test>
void forPointsAt(const glm::dvec3& exact, const Test& test) {
    Random random(2);
    int uncertain = 0;
    for (int round = 0; round < 4'000; ++round) {
        const glm::dvec3 third = dyadic(random, 1), across = std::ldexp(1.0, -round % 24) * dyadic(random, 1);
        const glm::dvec3 u = third + across, v = dyadic(random, 1);
        if (std::abs(glm::dot(glm::cross(u, v), third)) == 0) continue;
        const ReceiverPoint point({exact - third, 3.0 * third}, {exact + u, exact - u, exact + v});
        uncertain += glm::length(point.nearError()) > 1e-12;
        test(point);
    }
    EXPECT_GT(uncertain, 1000);
}

TEST(Blocking, OfAPointExactlyBelowAnEdgeTouchesHoweverTheReceiverLies) {
    const Triangle blocker{glm::dvec3(1, 1, -4), glm::dvec3(1, 1, 4), glm::dvec3(-3, 1, 0)};
    forPointsAt({2, 0, 0.75}, [&](const ReceiverPoint& point) {
        EXPECT_EQ(blocking(point, {0, 2, 0, 1}, blocker), Blocking::Touches);
        EXPECT_EQ(blocking(point, {-1, 1, 0, 0}, blocker), Blocking::Touches); // a direction
    });
}

TEST(Side, OfAPointInThePlaneIsZeroHoweverTheReceiverLies) {
    const Triangle plane{glm::dvec3(0, 2, 0), glm::dvec3(1, 1, -4), glm::dvec3(1, 1, 4)};
    forPointsAt({2, 0, 0.75}, [&](const ReceiverPoint& point) { EXPECT_EQ(side(plane, point), 0); });
}

/// The lowest and highest number of triangles over the point, from infinity and from a start that the triangle covers.
void expectOnBorder(const ReceiverPoint& point, const Triangle& triangle, const glm::dvec3& covered) {
    const Triangle ground{glm::dvec3(-9, 0, -9), glm::dvec3(-9, 0, 9), glm::dvec3(9, 0, 0)};
    const glm::dvec4 light(0, 2, 0, 1);
    const Triangle turned = facing(triangle, light);
    const ReceiverPoint start({covered + glm::dvec3(0, 1, 0), {0, -1, 0}}, ground);
    WindingAround fromInfinity(point, ground, light), fromStart(point, start, ground, light);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &a = turned[i], &b = turned[(i + 1) % 3];
        const SpatialEdge edge{{a, a, EdgePointKind::Vertex}, {b, b, EdgePointKind::Vertex}, 1};
        fromInfinity.add(edge);
        fromStart.add(edge);
    }
    for (const WindingAround::Range& range : {fromInfinity.range(), fromStart.range(1)}) {
        EXPECT_EQ(range.lowest, 0);
        EXPECT_EQ(range.highest, 1);
    }
}

TEST(WindingAround, APointExactlyBelowABorderHasBothNumbersHoweverTheReceiverLies) {
    const Triangle edge{glm::dvec3(1, 1, -4), glm::dvec3(1, 1, 4), glm::dvec3(-3, 1, 0)};
    const Triangle corner{glm::dvec3(1, 1, 0.375), glm::dvec3(1, 1, 4), glm::dvec3(-1, 1, 4)}; // on one side of the way
    forPointsAt({2, 0, 0.75}, [&](const ReceiverPoint& point) {
        expectOnBorder(point, edge, {0.5, 0, 0.125});
        expectOnBorder(point, corner, {0.5, 0, 5});
    });
}

} // namespace
} // namespace shadowbench::groundtruth::geometry
