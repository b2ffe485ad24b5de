// What starts processes has made no context before: a driver of a graphics processor does not outlive a fork, and one of
// software would not show it.
#include "base/temporary_folder.h"
#include "studies/recommend/recommendation.h"
#include "studies/sweep/sweep.h"
#include "techniques/gl/contexts_made.h"
#include "tests/support/cell_stage.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <pthread.h>

namespace shadowbench {
namespace {

int forks = 0, mostContexts = 0; // handlers of pthread_atfork take nothing

void noteFork() {
    ++forks;
    mostContexts = std::max(mostContexts, gl::contextsMade());
}

TEST(Forks, OfASweepComeBeforeAnyContextOfItsProcess) {
    ASSERT_EQ(gl::contextsMade(), 0) << "this file's tests have a process of their own";
    ASSERT_EQ(pthread_atfork(noteFork, nullptr, nullptr), 0);
    SweepOptions options;
    options.scene = "stacked-plates";
    options.axis = "map"; // whether a technique takes a value is known once it is made, in a context
    options.values = {256};
    options.techniques = {"sm-uniform"};
    options.cache = testCache().folder();
    options.quiet = true;
    EXPECT_EQ(sweep(options).records.size(), 1U);
    EXPECT_GE(forks, 2) << "one asks whether the values are taken, one scores";
    EXPECT_EQ(mostContexts, 0);

    options.values = {256, 3};
    try {
        sweep(options);
        FAIL() << "a map of three texels";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput) << error.what();
    }
    EXPECT_EQ(mostContexts, 0);
}

TEST(Forks, OfARecommendationComeBeforeAnyContextOfItsProcess) {
    ASSERT_EQ(gl::contextsMade(), 0);
    recommend::RecommendOptions options;
    options.scenes = {"stacked-plates"};
    options.questions = {recommend::Question::Technique, recommend::Question::Map}; // the first takes times
    options.techniques = {"sm-uniform", "none"};
    const TemporaryFolder out;
    options.out = out.path();
    options.cache = testCache().folder();
    options.quiet = true;
    forks = 0;
    EXPECT_EQ(recommend::recommend(options).scenes.size(), 1U);
    EXPECT_GE(forks, 3);
    EXPECT_EQ(mostContexts, 0);
}

} // namespace
} // namespace shadowbench
