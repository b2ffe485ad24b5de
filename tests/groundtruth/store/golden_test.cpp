#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "groundtruth/store/golden.h"
#include "tests/support/reference_samples.h"

#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

Reference golden() {
    Reference reference = sample(someKey);
    reference.id(0, 1) = 1U << 24;
    return reference;
}

TEST(ContentHashes, ChangeWithAnyValueOfTheirImageAndWithNoOther) {
    const ContentHashes before = contentHashes(golden());
    EXPECT_EQ(before.visibility.size(), 32U);
    const std::vector<std::pair<std::string ContentHashes::*, std::function<void(Reference&)>>> changes{
        {&ContentHashes::visibility, [](Reference& r) { r.visibility(3, 2) = 0.250001F; }},
        {&ContentHashes::sigma, [](Reference& r) { r.sigma(0, 0) = 2e-41F; }},
        {&ContentHashes::surface, [](Reference& r) { r.surface(1, 1) = Surface::Receiver; }},
        {&ContentHashes::id, [](Reference& r) { r.id(4, 2) = 8; }},
        {&ContentHashes::edgeDistance, [](Reference& r) { r.edgeDistance(1, 0) = 0.126F; }},
    };
    for (const auto& [image, change] : changes) {
        Reference changed = golden();
        change(changed);
        ContentHashes after = contentHashes(changed);
        EXPECT_NE(after.*image, before.*image);
        after.*image = before.*image;
        EXPECT_EQ(after, before);
    }
}

TEST(ContentHashes, DependOnTheSizeAndNotOnKeyProvenanceAndPositions) {
    Reference same = golden();
    same.provenance = {"rays", otherKey, 0, {}, 7, {}};
    same.position(0, 0).x = 5;
    EXPECT_EQ(contentHashes(same), contentHashes(golden()));

    Reference wide, high;
    wide.visibility = Image<float>(4, 2, 1);
    high.visibility = Image<float>(2, 4, 1);
    EXPECT_NE(contentHashes(wide).visibility, contentHashes(high).visibility);
}

TEST(GoldenDifference, OfEqualReferencesIsNothing) {
    EXPECT_EQ(difference(golden(), golden()), Difference{});
    EXPECT_EQ(describe(Difference{}), "");
}

TEST(GoldenDifference, CountsPixelsAndTheLargestChange) {
    Reference after = golden();
    after.visibility(0, 0) = 0.5F;                        // still in between
    after.visibility(1, 0) = 1;                           // now fully lit
    after.surface(2, 0) = Surface::OnEdge;                // another surface
    after.sigma(3, 0) = 0.125F;                           // from next to nothing
    after.id(4, 0) = 1;                                   //
    after.edgeDistance(1, 0) = 1.125F;                    // by one pixel
    after.edgeDistance(2, 0) = 3;                         // from infinity: counts, but is no finite change
    const Difference found = difference(golden(), after); // golden: V = ¼ everywhere
    EXPECT_EQ(found.labels, 2U);
    EXPECT_EQ(found.ids, 1U);
    EXPECT_EQ(found.visibility, (Difference::Values{2, 0.75}));
    EXPECT_EQ(found.sigma, (Difference::Values{1, 0.125}));
    EXPECT_EQ(found.edgeDistance, (Difference::Values{2, 1}));
    EXPECT_EQ(describe(found),
              "2 labels, 1 surface ids, visibility of 2 pixels by up to 0.75, σ of 1 pixels by up to 0.125, "
              "edge distance of 2 pixels by up to 1 px");
}

TEST(GoldenDifference, OfSizesIsAllThatIsSaid) {
    Reference small;
    small.visibility = Image<float>(2, 2);
    EXPECT_EQ(describe(difference(golden(), small)), "the image's size");
}

TEST(GoldenDifference, OfProvenanceNamesToolsAndMeasurementsButNeitherKeyNorTime) {
    const Provenance before{"polygon", someKey, 0, {{"cgal", "5.5"}, {"exact", "2"}}, 1, {{"bias", 0.5}}};
    Provenance after = before;
    after.key = otherKey;
    after.seconds = 9;
    EXPECT_EQ(describeChange(before, after), "");
    after = {"rays", otherKey, 4, {{"exact", "3"}, {"area", "1"}}, 9, {{"bias", 0.25}}};
    EXPECT_EQ(describeChange(before, after),
              "oracle polygon → rays, samples 0 → 4, area none → 1, cgal 5.5 → none, exact 2 → 3, bias 0.5 → 0.25");
}

class GoldenFile : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "golden.exr";
};

TEST_F(GoldenFile, HoldsAllThatIsHashedBitForBit) {
    writeGolden(golden(), file_);
    const Reference read = readGolden(file_);
    EXPECT_EQ(contentHashes(read), contentHashes(golden()));
    EXPECT_EQ(difference(read, golden()), Difference{});
}

TEST_F(GoldenFile, IsTheSameEachTime) {
    writeGolden(golden(), file_);
    writeGolden(golden(), folder_.path() / "again.exr");
    EXPECT_EQ(readFile(file_), readFile(folder_.path() / "again.exr"));
}

TEST_F(GoldenFile, RefusesIdsThatAFloatDoesNotHold) {
    Reference reference = golden();
    reference.id(0, 0) = (1U << 24) + 1;
    EXPECT_THROW(writeGolden(reference, file_), InternalError);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(GoldenFile, OfOtherImagesIsRefused) {
    EXPECT_THROW(readGolden(file_), BadInput);
    const Image<float> image(3, 2, 9);
    writeExr(file_, {{"V", &image}});
    EXPECT_THROW(readGolden(file_), BadInput);
    writeExr(file_, {{"V", &image}, {"sigma", &image}, {"edge_distance", &image}, {"surface", &image}, {"id", &image}});
    EXPECT_THROW(readGolden(file_), BadInput); // there is no surface number 9
}

} // namespace
} // namespace shadowbench::groundtruth
