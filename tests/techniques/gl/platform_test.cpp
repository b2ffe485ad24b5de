// What gives the process its OpenGL.
#include "techniques/gl/platform.h"

#include "base/error.h"
#include "techniques/gl/api.h"
#include "techniques/gl/counters.h"
#include "tests/support/test_context.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>

namespace shadowbench {
namespace {

using gl::Platform;

/// The environment variable SHADOWBENCH_GL for the length of a scope.
class Choice {
public:
    explicit Choice(const char* word) {
        if (const char* before = std::getenv(variable)) before_ = before;
        setenv(variable, word, 1);
    }
    ~Choice() {
        if (before_)
            setenv(variable, before_->c_str(), 1);
        else
            unsetenv(variable);
    }
    Choice(const Choice&) = delete;
    Choice& operator=(const Choice&) = delete;

private:
    static constexpr const char* variable = "SHADOWBENCH_GL";
    std::optional<std::string> before_;
};

TEST(Platform, IsReadFromTheEnvironment) {
    const auto chosenBy = [](const char* word) {
        const Choice choice(word);
        return gl::ContextOptions().platform;
    };
    EXPECT_EQ(chosenBy(""), Platform::Auto);
    EXPECT_EQ(chosenBy("osmesa"), Platform::OsMesa);
    EXPECT_EQ(chosenBy("egl"), Platform::Egl);
    try {
        const Choice wrong("glx");
        gl::chosenPlatform();
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_STREQ(error.what(),
                     "the environment variable SHADOWBENCH_GL is wrong: there is no OpenGL \"glx\"; there are auto, "
                     "osmesa, egl");
    }
}

TEST(Platform, OfTheTestsIsTheChosenOneAndInSoftware) {
    const gl::ContextInfo& info = testContext().info();
    EXPECT_EQ(info.platform == Platform::OsMesa, gl::drawsWithOsMesa());
    EXPECT_NE(info.platform, Platform::Auto);
    EXPECT_TRUE(info.software) << info.renderer << ": set LIBGL_ALWAYS_SOFTWARE=1, the tests know llvmpipe's figures";
    EXPECT_FALSE(info.vendor.empty());
    EXPECT_EQ(info.driver, gl::driverOf(info.version));
}

TEST(Platform, TwoDoNotStandSideBySide) {
    const Platform own = testContext().info().platform;
    gl::ContextOptions other;
    other.platform = own == Platform::Egl ? Platform::OsMesa : Platform::Egl;
    EXPECT_THROW(gl::Context::create(other), InternalError);
    EXPECT_EQ(&gl::Context::current(), &testContext());
}

TEST(Driver, IsWhatFollowsTheVersionOfOpenGl) {
    EXPECT_EQ(gl::driverOf("4.5 (Core Profile) Mesa 22.3.6"), "Mesa 22.3.6");
    EXPECT_EQ(gl::driverOf("4.6.0 NVIDIA 550.54.15"), "NVIDIA 550.54.15");
    EXPECT_EQ(gl::driverOf("4.6"), "");
    EXPECT_EQ(gl::driverOf(""), "");
}

TEST(TimeStamps, HaveAnIntervalFromEachToTheNextThatIsNotNegative) {
    testContext();
    if (!gl::TimeStamps::isSupported()) GTEST_SKIP() << "the driver has no timer";
    gl::TimeStamps stamps;
    for (int i = 0; i < 3; ++i) {
        glFinish();
        stamps.mark();
    }
    const std::vector<double> intervals = stamps.intervals();
    ASSERT_EQ(intervals.size(), 2U);
    EXPECT_TRUE(std::ranges::all_of(intervals, [](double each) { return each >= 0; }));
}

} // namespace
} // namespace shadowbench
