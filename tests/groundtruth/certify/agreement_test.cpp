#include "groundtruth/certify/agreement.h"

#include "base/error.h"
#include "scene/load/load.h"
#include "scene/scene.h"
#include "tests/support/povray_scene.h"

#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

Request platesByPoint() {
    Request request{overlappingPlates(), {96, 96}};
    request.snapshot.light = request.snapshot.light.centreOnly();
    return request;
}

TEST(OracleAgreement, PolygonAndRaysLabelThePlanarReceiversAlike) {
    const std::vector<Agreement> all = oracleAgreement(platesByPoint());
    ASSERT_EQ(all.size(), 1U);
    const Agreement& agreement = all.front();
    EXPECT_EQ(agreement.a, "polygon");
    EXPECT_EQ(agreement.b, "rays");
    EXPECT_GT(agreement.pixels, 4000U); // the ground fills most of the 9,216 pixels
    EXPECT_EQ(agreement.differing, 0U);
    EXPECT_EQ(agreement.onOneEdge, 0U);
    EXPECT_GT(agreement.secondsA, 0);
    EXPECT_GT(agreement.secondsB, 0);
}

TEST(OracleAgreement, InAPlanViewSceneThreeDerivationsAgree) {
    const Scene scene = loadScene("colonnade", Profile::Gate);
    const std::vector<Agreement> all = oracleAgreement({snapshot(scene, scene.timeline.still - 1), {128, 128}});
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].a, "plan");
    EXPECT_EQ(all[1].b, "polygon");
    EXPECT_GT(all[1].pixels, 5000U); // a third of the 16,384 pixels see the ground
    for (const Agreement& agreement : all) {
        EXPECT_EQ(agreement.differing, 0U) << agreement.a;
        EXPECT_EQ(agreement.onOneEdge, 0U) << agreement.a;
    }
}

TEST(OracleAgreement, IsEmptyWhereNoTwoOraclesApply) {
    EXPECT_TRUE(oracleAgreement({overlappingPlates(), {32, 32}}).empty()) << "an area light";
    Request ball = platesByPoint();
    ball.snapshot.batches.clear();
    ball.snapshot.batches.push_back(placed(sphere(1.0, 5000), at({0, 1, 0}), 1));
    EXPECT_TRUE(oracleAgreement(ball).empty()) << "no plane";
}

TEST(OracleAgreement, AContradictionOffTheEdgesIsInconclusiveAndNamesItsPixel) {
    Reference a, b;
    a.visibility = b.visibility = Image<float>(3, 2, 1);
    a.surface = b.surface = Image<Surface>(3, 2, Surface::Receiver);
    a.provenance.oracle = "rays";
    b.provenance.oracle = "polygon";
    Image<std::uint8_t> compared(3, 2, 1);
    b.visibility(0, 0) = 0;
    compared(0, 0) = 0;
    b.visibility(1, 0) = 0;
    a.surface(1, 0) = Surface::OnEdge;
    requireSameLabels(a, b, compared);
    b.visibility(2, 1) = 0;
    try {
        requireSameLabels(a, b, compared);
        ADD_FAILURE() << "a contradiction passes";
    } catch (const Inconclusive& error) {
        EXPECT_NE(std::string(error.what()).find("pixel (2, 1): rays says lit, polygon says shadowed"), std::string::npos)
            << error.what();
    }
}

TEST(OracleAgreement, CountsContradictionsAndEdgesApart) {
    Reference a, b;
    a.visibility = b.visibility = Image<float>(6, 1, 1);
    a.surface = b.surface = Image<Surface>(6, 1, Surface::Receiver);
    b.visibility[0] = 0;            // contradicts
    a.surface[1] = Surface::OnEdge; // on an edge for one …
    b.visibility[1] = 0;            // … which is no contradiction
    a.surface[2] = b.surface[2] = Surface::OnEdge;
    b.visibility[5] = 0; // not compared
    Image<std::uint8_t> compared(6, 1, 1);
    compared[5] = 0;
    Agreement agreement;
    countLabels(a, b, compared, agreement);
    EXPECT_EQ(agreement.pixels, 5U);
    EXPECT_EQ(agreement.differing, 1U);
    EXPECT_EQ(agreement.onOneEdge, 1U);
    EXPECT_EQ(agreement.onEdge, 1U);
}

} // namespace
} // namespace shadowbench::groundtruth
