// Figures with which the program contradicts a paper, computed again in double precision on the CPU: without rasteriser,
// shader or 16-bit buffers, from the papers' equations and the exact primary hits. The same figure within a twentieth means
// that the contradiction is the method's on this scene, and no slip of the shaders.
#include "techniques/shared/light_views/lispsm_view.h"
#include "techniques/shared/sampling/sampling.h"
#include "tests/support/cell_stage.h"
#include "tests/support/map_replay.h"
#include "tests/support/models/sm_history.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;

/// Receivers of a reference, in order.
struct Receiver {
    glm::dvec3 position;
    bool lit;
};

std::vector<Receiver> receiversOf(const Reference& truth) {
    std::vector<Receiver> receivers;
    for (int y = 0; y < truth.surface.height(); ++y)
        for (int x = 0; x < truth.surface.width(); ++x)
            if (truth.surface(x, y) == Surface::Receiver)
                receivers.push_back({glm::dvec3(truth.position(x, y)), truth.visibility(x, y) > 0.5F});
    return receivers;
}

/// Shares of the receivers that a history of jittered maps has wrong after each frame.
struct HistoryErrors {
    std::vector<double> mismatch, bad30;
};

/// Eq. 3.3, 3.6 and 3.7 over LiSPSM maps of 1,024², m = 3 + 0.1 a frame, translated and turned by Halton's sequence
/// (EGSR 2007, section 3), from an empty history while the camera stands still: nothing is reprojected.
HistoryErrors historyInDoublePrecision(CellScene& cells, int frames) {
    const Reference& truth = cells.truths().at(Truth::Hard, frames - 1);
    const std::vector<Receiver> receivers = receiversOf(truth);
    const Snapshot frame = snapshot(cells.scene(), frames - 1);
    const auto triangles = test::worldTriangles(frame);
    const glm::ivec2 size = cells.scene().size;
    const int side = 1024;
    const techniques::LightView base =
        techniques::fitLispsm(frame.light, frame, frame.camera, static_cast<double>(size.x) / size.y);

    std::vector<double> history(receivers.size());
    HistoryErrors errors;
    for (int n = 0; n < frames; ++n) {
        const std::uint32_t i = techniques::haltonIndex(n, 1);
        const techniques::LightView view =
            techniques::jittered(base, glm::two_pi<double>() * techniques::halton(i, 5),
                                 {techniques::halton(i, 2) - 0.5, techniques::halton(i, 3) - 0.5}, side);
        const test::MapReplay map(triangles, view, side);
        double wrong = 0, off = 0;
        for (std::size_t r = 0; r < receivers.size(); ++r) {
            const double lit = map.isLit(receivers[r].position) ? 1 : 0;
            const auto texel = techniques::texelAt(view, receivers[r].position, glm::dvec2(side));
            const double sure = texel ? models::confidence(*texel) : 0;
            history[r] = n == 0 ? lit : models::smoothed(history[r], lit, sure, 3 + 0.1 * n);
            const double label = receivers[r].lit ? 1 : 0;
            wrong += (history[r] >= 0.5) != receivers[r].lit ? 1 : 0;
            off += std::abs(history[r] - label) > 30.0 / 255 ? 1 : 0;
        }
        errors.mismatch.push_back(wrong / static_cast<double>(receivers.size()));
        errors.bad30.push_back(off / static_cast<double>(receivers.size()));
    }
    return errors;
}

// K2, K4 and K7: the paper calls a history over LiSPSM pixel-exact after 10 to 60 frames.
TEST(HistoryReplay, ErrsAsTheRecordSays) {
    CellScene& cells = stillScene("dueling-frusta");
    const Record& record = cells.scored("sm-history");
    const HistoryErrors replay = historyInDoublePrecision(cells, 60);
    const auto& mismatch = record.values.list("stability.by_frame.mismatch");
    const auto& bad30 = record.values.list("stability.by_frame.bad30");
    for (const std::size_t frame : {0U, 9U, 19U, 39U, 59U}) {
        EXPECT_NEAR(replay.mismatch[frame], mismatch[frame], 0.05 * mismatch[frame]) << frame;
        EXPECT_NEAR(replay.bad30[frame], bad30[frame], 0.05 * bad30[frame]) << frame;
    }
}

} // namespace
} // namespace shadowbench
