// A POV-Ray with a fault in its lights: what the certificate refuses by itself, whatever is locked. On all scenes and with
// more seeds: benchmarks/truth_faults.cpp.
#include "base/temporary_folder.h"
#include "tests/support/certificates.h"
#include "tests/support/honest_seeds.h"
#include "tests/support/povray_scene.h"
#include "tests/support/povray_wrapper.h"

#include <gtest/gtest.h>

namespace shadowbench::groundtruth {
namespace {

const Request& request() {
    static const Request plates{overlappingPlates(), {96, 96}, Truth::Soft, 256};
    return plates;
}

povray::Render renderBy(const Request& asked, Wrapper wrapper) {
    const TemporaryFolder folder;
    povray::Options options;
    options.program =
        writeWrapper(folder.path(), wrapper, asked.snapshot.light, asked.samples, povray::scaleOf(asked.snapshot));
    return povray::render(asked.snapshot, asked.size, asked.samples, options);
}

Certificate certificateOf(const Request& asked, const povray::Render& image) {
    return certify(asked, image, hard::primaryHits(asked.snapshot, asked.size), certificatePointCount, 2);
}

TEST(WrappedPovRay, IsCertifiedWhereTheScriptChangesNothing) {
    const povray::Render image = renderBy(request(), Wrapper::Honest);
    const Certificate c = certificateOf(request(), image);
    EXPECT_EQ(rejection(requireCertified, c, request().samples), "") << describe(c);
    EXPECT_GT(c.penumbra, 500);
    EXPECT_LT(c.replayed, 0.02) << "POV-Ray and the exact oracle see the same samples but for rounding";
}

class WrappedPovRayWith : public testing::TestWithParam<std::size_t> {};

TEST_P(WrappedPovRayWith, AFaultIsRefused) {
    const Wrapper wrapper = faultyWrappers[GetParam()];
    const Certificate c = certificateOf(request(), renderBy(request(), wrapper));
    EXPECT_NE(rejection(requireCertified, c, request().samples), "") << name(wrapper) << ": " << describe(c);
}

INSTANTIATE_TEST_SUITE_P(Faults, WrappedPovRayWith, testing::Range<std::size_t>(0, faultyWrappers.size()));

/// Without looking at single samples: by how honest renders err.
TEST(WrappedPovRay, LargeFaultsAreOutsideOfWhatHonestRendersErrBy) {
    for (const Wrapper wrapper : {Wrapper::ShiftedByFour, Wrapper::EveryFiftiethDropped}) {
        Certificate c = certificateOf(request(), renderBy(request(), wrapper));
        c.replayed = 0;
        EXPECT_NE(rejection(requireCertified, c, request().samples), "") << name(wrapper) << ": " << describe(c);
    }
    const Request parallel{halfPlane(LightKind::Rectangle), {64, 64}, Truth::Soft, 256};
    Certificate grid = certificateOf(parallel, renderBy(parallel, Wrapper::PlainGrid));
    grid.replayed = 0;
    EXPECT_NE(rejection(requireCertified, grid, parallel.samples), "") << describe(grid);
}

TEST(HonestSeeds, AreAllWithinTheBounds) {
    const PrimaryHits primary = hard::primaryHits(request().snapshot, request().size);
    const povray::Render image = renderBy(request(), Wrapper::Honest);
    const Certificate c = certificateOf(request(), image);
    ASSERT_TRUE(c.honest);
    const area::AreaScene scene(request().snapshot, 2);
    const std::vector<glm::ivec2> pixels = certificatePoints(image, primary, certificatePointCount);
    for (const Certificate& seed : certificatesOfSeeds(scene, request(), primary, pixels, *c.honest, 200))
        EXPECT_EQ(rejection(requireCertified, seed, request().samples), "") << describe(seed);
}

} // namespace
} // namespace shadowbench::groundtruth
