// How an error is split, and the rows that the split is made with.
#include "scene/meshes/primitives.h"
#include "studies/causes/casters_alone.h"
#include "studies/causes/experiments.h"
#include "studies/causes/ladder.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::causes {
namespace {

constexpr int side = 17; // a window holds all of it from its middle

/// Errors of 1 at every `step`-th pixel from `first` on.
Image<float> every(std::size_t step, std::size_t first = 0) {
    Image<float> errors(side, side);
    for (std::size_t i = first; i < errors.size(); i += step) errors[i] = 1;
    return errors;
}

double total(const Image<float>& image) {
    double sum = 0;
    for (const float value : image) sum += value;
    return sum;
}

TEST(Ladder, AnExperimentTakesWhatIsGoneWithoutItsCause) {
    Ladder ladder(every(2));
    ladder.take(Cause::Filter, every(2), every(4));
    ladder.take(Cause::Undersampled, every(4), Image<float>(side, side));
    const Split split = std::move(ladder).finish();
    for (std::size_t i = 0; i < side * side; ++i) {
        EXPECT_EQ(split.at(Cause::Filter)[i], i % 4 == 2 ? 1 : 0);
        EXPECT_EQ(split.at(Cause::Undersampled)[i], i % 4 == 0 ? 1 : 0);
        EXPECT_EQ(split.at(Cause::Method)[i], 0);
    }
}

TEST(Ladder, AnImageThatIsWrongElsewhereAsOftenHasLostNoCause) {
    Ladder ladder(every(2));
    ladder.take(Cause::Undersampled, every(2), every(2, 1)); // acne of finer texels: other pixels, as many
    ladder.take(Cause::SmallBias, every(2, 1), Image<float>(side, side));
    const Split split = std::move(ladder).finish();
    EXPECT_LT(total(split.at(Cause::Undersampled)), 0.02 * side * side);
    EXPECT_GT(total(split.at(Cause::SmallBias)), 0.48 * side * side);
}

TEST(Ladder, ErrorsThatAnExperimentAddsBelongToNoCause) {
    Ladder ladder(every(4));
    ladder.take(Cause::Filter, every(4), every(1)); // unfiltered, and worse
    ladder.take(Cause::Undersampled, every(1), Image<float>(side, side));
    const Split split = std::move(ladder).finish();
    EXPECT_EQ(total(split.at(Cause::Filter)), 0);
    EXPECT_EQ(split.at(Cause::Undersampled), every(4));
}

TEST(Ladder, CausesAddUpToTheErrorAtEveryPixel) {
    Image<float> error(side, side), some(side, side), less(side, side);
    for (std::size_t i = 0; i < error.size(); ++i) {
        error[i] = static_cast<float>(i % 7) / 7;
        some[i] = static_cast<float>(i % 5) / 7;
        less[i] = static_cast<float>(i % 3) / 9;
    }
    Ladder ladder(error);
    ladder.take(Cause::History, error, some);
    ladder.take(
        {Cause::Leak, Cause::Fusion}, [](std::size_t i) { return i % 2 == 0 ? Cause::Leak : Cause::Fusion; }, some, less);
    const Split split = std::move(ladder).finish();
    for (std::size_t i = 0; i < error.size(); ++i) {
        float sum = 0;
        for (const auto& [cause, part] : split) sum += part[i];
        EXPECT_NEAR(sum, error[i], 1e-6);
        EXPECT_EQ(split.at(i % 2 == 0 ? Cause::Fusion : Cause::Leak)[i], 0);
    }
    EXPECT_FALSE(split.contains(Cause::Filter)) << "no experiment";
}

std::string valueIn(const std::optional<Parameters>& row, std::string_view name) { return row ? row->text(name) : "none"; }

TEST(Experiments, KeepTheBiasInTheWorldOverFinerTexels) {
    const auto row = techniques::parseVariant("sm-uniform:map=1024,factor=3,units=7");
    const auto fine = withFineTexels(*row.entry, row.parameters);
    EXPECT_EQ(valueIn(fine, "map"), "8192");
    EXPECT_EQ(valueIn(fine, "factor"), "24"); // eight texels where there was one
    EXPECT_EQ(valueIn(fine, "units"), "7");   // of the depth range
    const auto own = withOwnBias(*row.entry, *fine);
    EXPECT_EQ(valueIn(own, "factor"), "2");
    EXPECT_EQ(valueIn(own, "units"), "64");
    EXPECT_FALSE(withFineTexels(*row.entry, *fine)) << "the map is at its limit";
}

TEST(Experiments, ABiasThatSufficesIsOfTheTechniquesOwnKindAndSize) {
    const auto none = techniques::parseVariant("sm-uniform:bias=none,units=0");
    const auto enough = withEnoughBias(*none.entry, none.parameters);
    EXPECT_EQ(valueIn(enough, "bias"), "slope");
    EXPECT_EQ(valueIn(enough, "factor"), "2");
    EXPECT_EQ(valueIn(enough, "units"), "64");
    const auto more = techniques::parseVariant("sm-uniform:factor=16");
    EXPECT_FALSE(withEnoughBias(*more.entry, more.parameters));
    const auto exact = techniques::parseVariant("sm-alias-free");
    EXPECT_FALSE(withEnoughBias(*exact.entry, exact.parameters)) << "it has no bias";
    EXPECT_FALSE(withFineTexels(*exact.entry, exact.parameters)) << "nor texels";
}

TEST(Experiments, TheLeastFilterIsTheLowEndOfItsParameter) {
    const auto vsm = techniques::parseVariant("vsm"), poisson = techniques::parseVariant("pcf-poisson");
    EXPECT_EQ(valueIn(withLeastFilter(*vsm.entry, vsm.parameters), "kernel"), "1");
    EXPECT_EQ(valueIn(withLeastFilter(*poisson.entry, poisson.parameters), "radius"), "0.5");
    const auto uniform = techniques::parseVariant("sm-uniform");
    EXPECT_FALSE(withLeastFilter(*uniform.entry, uniform.parameters));
}

std::string against(Cause cause, const std::string& row) {
    const auto variant = techniques::parseVariant(row);
    return changeAgainst(cause, *variant.entry, variant.parameters);
}

TEST(Experiments, TexelsOfPagesAreFinerByDensityAndNotByMemory) {
    const auto row = techniques::parseVariant("sm-adaptive:factor=3");
    const auto fine = withFineTexels(*row.entry, row.parameters);
    EXPECT_EQ(valueIn(fine, "density"), "8");
    EXPECT_EQ(valueIn(fine, "map"), row.parameters.text("map"));
    EXPECT_EQ(valueIn(fine, "factor"), "24");
    EXPECT_EQ(valueIn(fine, "page"), "1024"); // (1024 · 2^levels)² texels
    const auto small = techniques::parseVariant("sm-adaptive:map=256");
    EXPECT_EQ(valueIn(withFineTexels(*small.entry, small.parameters), "page"), "256");
}

TEST(Experiments, LessBiasIsAQuarterAndOfAVarianceThatOfADeviation) {
    const auto uniform = techniques::parseVariant("sm-uniform:factor=3,units=8"), vsm = techniques::parseVariant("vsm");
    const auto less = withLessBias(*uniform.entry, uniform.parameters);
    EXPECT_EQ(valueIn(less, "factor"), "0.75");
    EXPECT_EQ(valueIn(less, "units"), "2");
    EXPECT_EQ(valueIn(withLessBias(*vsm.entry, vsm.parameters), "variance"), "6.25e-08");
    const auto exact = techniques::parseVariant("sm-alias-free");
    EXPECT_FALSE(withLessBias(*exact.entry, exact.parameters));
}

TEST(Experiments, WhatToChangeIsAParameterThatTheRowHas) {
    EXPECT_EQ(against(Cause::Undersampled, "sm-uniform:map=512"), "map=1024");
    EXPECT_EQ(against(Cause::Filter, "pcf:kernel=7"), "kernel=5");
    EXPECT_EQ(against(Cause::SmallBias, "sm-uniform:bias=none"), "bias=slope");
    EXPECT_EQ(against(Cause::LargeBias, "sm-uniform:factor=16"), "factor=2");
    EXPECT_EQ(against(Cause::LargeBias, "sm-uniform"), "map=2048");       // a smaller one would be too small
    EXPECT_EQ(against(Cause::LargeBias, "deep-sm:map=1024"), "factor=1"); // at its limit
    EXPECT_EQ(against(Cause::LargeBias, "sm-uniform:map=8192,bias=constant"), "units=32");
    EXPECT_EQ(against(Cause::LargeBias, "vsm"), "variance=5e-07"); // whatever its texels
    EXPECT_EQ(against(Cause::Undersampled, "sm-adaptive"), "density=2,page=256");
    EXPECT_EQ(against(Cause::Undersampled, "sm-adaptive:page=512,map=512"), "density=2");
    EXPECT_EQ(against(Cause::Outside, "sm-psm:behind=lost"), "behind=negative-near");
    EXPECT_EQ(against(Cause::FewSamples, "pcss"), "taps=32+32");
    EXPECT_EQ(against(Cause::Leak, "vsm"), "bleeding=0.2");
    EXPECT_EQ(against(Cause::Undersampled, "sm-uniform:map=8192"), "");
}

TEST(CastersAlone, StandInOneGroupEachBesideTheGroundAndKeepAllBounds) {
    Batch ground{std::make_shared<const Mesh>(box({9, 0.2, 9})), glm::vec3(1), false, {{glm::dmat4(1), glm::dmat4(1), 1}}};
    Batch boxes{std::make_shared<const Mesh>(box({1, 2, 3})), glm::vec3(1), false, {}};
    for (std::uint32_t id = 2; id <= 6; ++id) boxes.placements.push_back({glm::dmat4(1), glm::dmat4(1), id});
    const auto groups = castersAlone({ground, boxes}, 1, 3);
    ASSERT_EQ(groups.size(), 4U);
    std::multiset<std::uint32_t> standing;
    for (const std::vector<Batch>& group : groups) {
        Snapshot snapshot;
        snapshot.batches = group;
        std::size_t placements = 0;
        for (const Batch& batch : group) {
            placements += batch.placements.size();
            EXPECT_TRUE(batch.mesh->closed);
            EXPECT_NO_THROW(requireWellFormed(*batch.mesh, "a batch"));
            if (batch.mesh != boxes.mesh && batch.mesh != ground.mesh) {
                EXPECT_EQ(batch.mesh->bounds().low, boxes.mesh->bounds().low);
                EXPECT_EQ(batch.mesh->bounds().high, boxes.mesh->bounds().high);
                continue;
            }
            for (const Placement& placement : batch.placements) standing.insert(placement.id);
        }
        EXPECT_EQ(placements, 6U);
    }
    EXPECT_EQ(standing, (std::multiset<std::uint32_t>{1, 1, 1, 1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(castersAlone({ground}, 1, 3).empty()) << "nothing to combine";
}

} // namespace
} // namespace shadowbench::causes
