// The half-life of ghosts, on shadows that come and go over a plane and a history that fades exponentially.
#include "tests/support/metrics_images.h"

#include <cmath>
#include <deque>
#include <gtest/gtest.h>
#include <optional>

namespace shadowbench {
namespace {

using groundtruth::Reference;

constexpr int side = 64;

enum class Edge { Upright, Level };

/// What a technique shows of a plane seen by a camera at rest, frame by frame; lit from column, or row, `edge` on.
class Shown {
public:
    explicit Shown(Edge edge = Edge::Upright) : axis_(edge == Edge::Upright ? 0 : 1) {}

    /// With V = (1 − weight) V* + weight V of the frame before, which is V* in the first frame.
    void add(double edge, double weight) {
        Frame& now = frames_.emplace_back();
        now.truth = test::truthOf(side, side, [&](glm::dvec2 p) { return p[axis_] < edge ? 0 : 1; });
        now.mask = test::everything(now.truth);
        now.v = now.truth.visibility;
        if (frames_.size() < 2) return;
        const Image<float>& before = frames_[frames_.size() - 2].v;
        for (std::size_t i = 0; i < now.v.size(); ++i)
            now.v[i] = static_cast<float>((1 - weight) * now.truth.visibility[i] + weight * before[i]);
    }

    [[nodiscard]] std::optional<double> halfLife(bool remembers = true) const {
        Image<glm::vec2> still(side, side);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) still(x, y) = glm::vec2(x, y) + 0.5F;
        metrics::MovingFrames frames{{}, remembers};
        for (std::size_t i = 1; i < frames_.size(); ++i) {
            const Frame &now = frames_[i], &before = frames_[i - 1];
            frames.pairs.push_back({{now.v, now.truth, now.mask}, {before.v, before.truth, before.mask}, still});
        }
        return metrics::ghostHalfLife(frames);
    }

private:
    struct Frame {
        Reference truth;
        Image<float> v;
        metrics::Mask mask;
    };
    int axis_;
    std::deque<Frame> frames_;
};

/// The shadow's edge jumps by 20 pixels between the first frame and the second.
Shown afterAJump(double weight, int frames = 5) {
    Shown shown;
    shown.add(20, weight);
    for (int i = 1; i < frames; ++i) shown.add(40, weight);
    return shown;
}

double exact(double weight) { return std::log(2.0) / -std::log(weight); }

TEST(GhostHalfLife, OfAnExponentialDecayIsItsOwn) {
    // 0.98 has halved after 34 frames, 0.9 after 6.6, of which four are shown; 0.5 after one, 0.2 within the first.
    for (const double weight : {0.98, 0.9, 0.7, 0.5, 0.2})
        EXPECT_NEAR(afterAJump(weight).halfLife().value_or(-1), exact(weight), 1e-3 * exact(weight)) << weight;
}

TEST(GhostHalfLife, OfAShadowThatKeepsMovingIsThatOfEachPart) {
    for (const double weight : {0.9, 0.6}) {
        Shown shown;
        for (const double edge : {20, 28, 36, 44, 52}) shown.add(edge, weight);
        EXPECT_NEAR(shown.halfLife().value_or(-1), exact(weight), 1e-3 * exact(weight)) << weight;
    }
}

TEST(GhostHalfLife, IsOfShadowsThatComeAsOfShadowsThatGo) {
    Shown shown;
    for (const double edge : {40, 20, 20, 20}) shown.add(edge, 0.8);
    EXPECT_NEAR(shown.halfLife().value_or(-1), exact(0.8), 1e-3 * exact(0.8));
}

TEST(GhostHalfLife, IsAbsentWithoutHistoryOrGhostAndWhereNothingFades) {
    EXPECT_FALSE(afterAJump(0.9).halfLife(false)) << "no history";
    EXPECT_FALSE(afterAJump(0.04).halfLife()) << "no ghost";
    EXPECT_FALSE(afterAJump(1).halfLife()) << "the old shadow stays";
    EXPECT_FALSE(afterAJump(0.9, 2).halfLife()) << "one frame shows no decay";
    Shown resting;
    for (int i = 0; i < 4; ++i) resting.add(20, 0.9);
    EXPECT_FALSE(resting.halfLife()) << "nothing moves";
}

TEST(GhostHalfLife, OfAShadowThatComesBackTooDarkIsWhereALineIsHalf) {
    Shown shown;
    shown.add(20, 0);
    shown.add(40, 0.6);
    for (int i = 0; i < 3; ++i) shown.add(40, -0.25); // shares of 0.6 and −0.15: no exponential passes through both
    EXPECT_NEAR(shown.halfLife().value_or(-1), (0.6 - 0.3) / (0.6 + 0.15), 1e-6);
}

TEST(GhostHalfLife, IsOfPixelsWithAllTheirNeighbours) {
    for (const Edge edge : {Edge::Upright, Edge::Level})
        for (const double to : {37, 43}) { // of three rows the middle one has neighbours that change with it
            Shown shown(edge);
            for (const double at : {40.0, to, to, to}) shown.add(at, 0.8);
            EXPECT_NEAR(shown.halfLife().value_or(-1), exact(0.8), 1e-3 * exact(0.8)) << to;
        }
}

TEST(GhostHalfLife, LeavesOutLabelsThatStepAlongAnEdge) {
    Shown stepping; // an edge that moves by two pixels leaves no pixel whose neighbours have all changed
    for (const double edge : {20, 22, 24, 26, 28}) stepping.add(edge, 0.9);
    EXPECT_FALSE(stepping.halfLife());
}

} // namespace
} // namespace shadowbench
