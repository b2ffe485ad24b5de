// Winding numbers at pixel centres, where edges end and cross exactly on rows and columns of centres.
#include "groundtruth/cgal/hard/scanline.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr glm::ivec2 size(9, 9);

/// A square on its corner, all of which are pixel centres: |x − 4.5| + |y − 4.5| ≤ 3. It covers what it encloses.
std::vector<PixelEdge> diamond() {
    const glm::dvec2 top(4.5, 1.5), left(1.5, 4.5), bottom(4.5, 7.5), right(7.5, 4.5);
    return {{top, left, 1, 0, 0}, {left, bottom, 1, 0, 1}, {bottom, right, 1, 0, 2}, {right, top, 1, 0, 3}};
}

/// Whether `number` is the winding number at a centre; on the border either side is right.
bool isRight(int number, int x, int y) {
    const int distance = std::abs(x - scanMargin - 4) + std::abs(y - scanMargin - 4);
    return distance == 3 || number == (distance < 3 ? 1 : 0);
}

TEST(Scanline, EndsOfEdgesOnARowOfCentresCountOnce) {
    const Winding winding = scan(diamond(), size);
    for (int y = 0; y < winding.change.height(); ++y) {
        int number = 0;
        for (int x = 0; x < winding.change.width(); ++x) {
            number += winding.change(x, y);
            EXPECT_TRUE(isRight(number, x, y)) << x << ", " << y << ": " << number;
        }
    }
}

TEST(Scanline, EndsOfEdgesOnAColumnOfCentresCountOnce) {
    const Winding winding = scan(diamond(), size);
    for (int x = 0; x < winding.changeDown.width(); ++x) {
        int number = 0;
        for (int y = 0; y < winding.changeDown.height(); ++y) {
            number += winding.changeDown(x, y);
            EXPECT_TRUE(isRight(number, x, y)) << x << ", " << y << ": " << number;
        }
    }
}

} // namespace
} // namespace shadowbench::groundtruth::hard
