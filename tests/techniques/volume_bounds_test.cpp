// Which casters' shadow volumes the view may meet: closed forms, and points of both on random arrangements.
#include "base/random.h"
#include "techniques/shared/casters/volume_bounds.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace shadowbench::techniques {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// From the origin along −z, a right angle wide and high.
ViewPyramid viewTo(double depth, const glm::dvec3& eye = {0, 0, 0}) {
    return {{eye, eye + glm::dvec3(0, 0, -1), {0, 1, 0}, 90, 0.1, 10}, 1, depth};
}

/// Of a cube of 2 m around `at`.
VolumeBounds volumeOf(const glm::dvec3& at, std::initializer_list<glm::dvec4> lights) {
    return {{glm::dvec3(-1), glm::dvec3(1)}, glm::translate(glm::dmat4(1), at), std::span(lights.begin(), lights.size())};
}

TEST(VolumeBounds, ACasterOutOfViewCountsWhereItsShadowMayBeInView) {
    EXPECT_TRUE(volumeOf({0, 0, -5}, {{0, 9, 0, 1}}).mayMeet(viewTo(10)));
    EXPECT_TRUE(volumeOf({0, 0, 5}, {{0, 0, 9, 1}}).mayMeet(viewTo(10))); // behind the eye, lit from behind
    EXPECT_FALSE(volumeOf({0, 0, 5}, {{0, 0, -9, 1}}).mayMeet(viewTo(10)));
    EXPECT_TRUE(volumeOf({-20, 0, -5}, {{-40, 0, -5, 1}}).mayMeet(viewTo(10))); // to the left, lit from the left
    EXPECT_FALSE(volumeOf({-20, 0, -5}, {{5, 0, -5, 1}}).mayMeet(viewTo(10)));
    EXPECT_TRUE(volumeOf({0, 30, -5}, {{0, 1, 0, 0}}).mayMeet(viewTo(10))); // under the sun in the zenith
    EXPECT_FALSE(volumeOf({0, 30, -5}, {{0, -1, 0, 0}}).mayMeet(viewTo(10)));
    EXPECT_FALSE(volumeOf({0, 30, 5}, {{0, 1, 0, 0}}).mayMeet(viewTo(10)));
}

TEST(VolumeBounds, BeyondTheFarPlaneAVolumeIsSeenOnlyWhereThereIsNone) {
    const VolumeBounds away = volumeOf({0, 0, -20}, {{0, 0, 0, 1}});
    EXPECT_FALSE(away.mayMeet(viewTo(10)));
    EXPECT_TRUE(away.mayMeet(viewTo(unbounded)));
    EXPECT_FALSE(volumeOf({0, 0, 20}, {{0, 0, 0, 1}}).mayMeet(viewTo(unbounded)));
}

TEST(VolumeBounds, ALightWithinTheBoxMayHideEverything) {
    EXPECT_TRUE(volumeOf({0, 0, 30}, {{0.5, 0, 30, 1}}).mayMeet(viewTo(10)));
}

TEST(VolumeBounds, HoldsTheShadowsOfAllPointsOfTheLight) {
    const glm::dvec4 away(20, 0, 0, 1), behind(-60, 0, 0, 1);
    EXPECT_FALSE(volumeOf({-30, 0, -5}, {away}).mayMeet(viewTo(10)));
    EXPECT_TRUE(volumeOf({-30, 0, -5}, {away, behind}).mayMeet(viewTo(10)));
}

TEST(VolumeBounds, BeginsWhereTheNearRectangleTouchesTheShadow) {
    // The light is 10 m above the eye, the cube's top 6 m: its upper edges shade up to 1 · (10 + 0.1) / (10 − 6) from the
    // middle at the height of the near rectangle's lower corners, which are 0.1 m to each side and below.
    const double border = 10.1 / 4 + 0.1;
    const VolumeBounds shadow = volumeOf({0, 5, 0}, {{0, 10, 0, 1}});
    EXPECT_TRUE(shadow.mayMeet(viewTo(0.1, {0, 0, 0})));
    EXPECT_TRUE(shadow.mayMeet(viewTo(0.1, {border - 0.001, 0, 0})));
    EXPECT_FALSE(shadow.mayMeet(viewTo(0.1, {border + 0.001, 0, 0})));
}

/// A camera, a caster and a light anywhere within 10 m.
struct Arrangement {
    explicit Arrangement(Random& random)
        : place(
              glm::rotate(glm::translate(glm::dmat4(1), within(random, 10)), random.uniform(0, 6), glm::dvec3(0.6, 0.8, 0))),
          light(within(random, 10), random.uniform() < 0.5 ? 1 : 0) {
        camera.eye = within(random, 10);
        camera.target = camera.eye + within(random, 1);
        camera.fovy = random.uniform(20, 100);
        camera.far = random.uniform(2, 15);
        const glm::dvec3 half = glm::abs(within(random, 2)) + 0.01;
        box = {-half, half};
    }

    static glm::dvec3 within(Random& random, double reach) {
        const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
        return {x, y, random.uniform(-reach, reach)};
    }

    /// Whether the light is hidden from a point by the box.
    [[nodiscard]] bool hides(const glm::dvec3& point) const {
        const glm::dmat4 objectFromWorld = glm::inverse(place);
        const glm::dvec3 from = objectFromWorld * glm::dvec4(point, 1);
        const glm::dvec3 along = objectFromWorld * (light - light.w * glm::dvec4(point, 1));
        double enter = 0, leave = light.w == 0 ? unbounded : 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double t0 = (box.low[axis] - from[axis]) / along[axis], t1 = (box.high[axis] - from[axis]) / along[axis];
            enter = std::max(enter, std::min(t0, t1));
            leave = std::min(leave, std::max(t0, t1));
        }
        return enter < leave;
    }

    glm::dmat4 place;
    glm::dvec4 light;
    Camera camera;
    Bounds box;
};

TEST(VolumeBounds, NoPointThatIsSeenLiesInAVolumeThatIsLeftOut) {
    Random random(17);
    constexpr double aspect = 1.5;
    int left = 0, empty = 0;
    for (int i = 0; i < 2000; ++i) {
        const Arrangement arranged(random);
        const bool mayMeet = VolumeBounds(arranged.box, arranged.place, {&arranged.light, 1})
                                 .mayMeet({arranged.camera, aspect, arranged.camera.far});
        bool meets = false;
        for (int sample = 0; sample < 400; ++sample) {
            const glm::dvec3 ray = arranged.camera.ray({random.uniform(0, 300), random.uniform(0, 200)}, {300, 200});
            meets = meets || arranged.hides(arranged.camera.eye + arranged.camera.far * random.uniform() * ray);
        }
        ASSERT_TRUE(mayMeet || !meets) << i;
        left += mayMeet ? 0 : 1;
        empty += meets ? 0 : 1;
    }
    EXPECT_GT(left, 300);
    EXPECT_GT(left, 0.8 * empty); // few are kept for nothing
}

} // namespace
} // namespace shadowbench::techniques
