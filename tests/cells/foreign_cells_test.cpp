// Images of this program's own techniques, written as float EXR and scored as another renderer's, score what they scored.
#include "base/error.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "harness/foreign/receivers.h"
#include "harness/foreign/score_images.h"
#include "tests/support/cell_stage.h"
#include "tests/support/stages.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

/// A box that moves over a slab in the last two of five frames.
Scene movingScene(const Light& light) {
    Scene scene = boxScene(96);
    scene.id = "moving";
    scene.light = light;
    scene.timeline = {3, 2};
    scene.referenceSamples = scene.movingReferenceSamples = 64;
    scene.objects.back().motion.shift.keys = {{0, {0, 0, 0}}, {2, {0.12, 0, 0.05}}};
    return scene;
}

const Light pointLight{LightKind::Point, {1.7, 6.1, -2.3}, {0, -1, 0}, {}, {}};
const Light areaLight{LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};

/// A scene whose cells are scored twice: as they were drawn, and from files.
class BothWays {
public:
    explicit BothWays(const Light& light) : cells_(movingScene(light)) {}

    CellScene& cells() { return cells_; }

    /// Scores the variant's cell and keeps its images.
    Record own(const std::string& variant) {
        Record record;
        images_ = {};
        scoreCell(cells_.frames(), techniques::parseVariant(variant), 1, record, images_);
        return record;
    }

    /// The row of these images: of all frames, or of the still one.
    ForeignRow row(Definition definition, bool all = true) {
        ForeignRow row{.id = "own", .definition = definition, .frames = {}};
        for (const auto& [frame, v] : images_.frames) {
            const std::filesystem::path file = folder_.path() / fmt::format("frame-{}.exr", frame);
            writeExr(file, {{"V", &v}});
            if (all || row.frames.empty()) row.frames.push_back({.frame = frame, .image = file});
        }
        return row;
    }

    Record scored(const ForeignRow& row) {
        warnings_.clear();
        return scoreImages(cells_.frames(), row, warnings_);
    }

    std::map<int, Image<float>>& images() { return images_.frames; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

private:
    CellScene cells_;
    CellImages images_;
    TemporaryFolder folder_;
    std::vector<std::string> warnings_;
};

BothWays& underPoint() {
    testContext();
    static BothWays scene(pointLight);
    return scene;
}
BothWays& underArea() {
    testContext();
    static BothWays scene(areaLight);
    return scene;
}

void expectSameScores(const Record& own, const Record& foreign, const std::vector<std::string_view>& groups) {
    std::size_t compared = 0;
    for (const metrics::Metric& line : metrics::table)
        for (const std::string_view group : groups) {
            if (!line.path.starts_with(group)) continue;
            EXPECT_EQ(own.values[line], foreign.values[line]) << line.path;
            compared += own.values[line] ? 1 : 0;
        }
    EXPECT_GT(compared, 10U);
    EXPECT_EQ(own.reference->key, foreign.reference->key);
    EXPECT_EQ(own.softReference.has_value(), foreign.softReference.has_value());
    EXPECT_EQ(own.pixelReference.has_value(), foreign.pixelReference.has_value());
}

void expectSameBothWays(BothWays& scene, const std::string& variant, Definition definition) {
    SCOPED_TRACE(variant);
    const Record own = scene.own(variant), foreign = scene.scored(scene.row(definition));
    expectSameScores(own, foreign, {"accuracy.", "stability."});
    EXPECT_EQ(own.images, foreign.images);
    EXPECT_EQ(foreign.technique, "external:own");
    EXPECT_EQ(foreign.status, Status::Scored);
    EXPECT_NO_THROW(parseRecord(toJson(foreign)));
}

TEST(ForeignCells, HardAndFilteredImagesScoreAsTheCellsDid) {
    for (const char* variant : {"sm-uniform", "volume-zfail", "pcf", "vsm"})
        expectSameBothWays(underPoint(), variant, Definition::Hard);
    EXPECT_TRUE(underPoint().warnings().empty());
}

TEST(ForeignCells, SoftImagesAndHardOnesUnderAnAreaLightScoreAsTheCellsDid) {
    expectSameBothWays(underArea(), "pcss", Definition::Area);
    expectSameBothWays(underArea(), "sm-uniform", Definition::Hard);
}

TEST(ForeignCells, EachMeaningIsScoredAgainstItsOwnTruth) {
    BothWays& scene = underArea();
    scene.own("sm-uniform");
    const std::pair<Definition, Truth> pairs[] = {{Definition::Irradiance, Truth::Irradiance},
                                                  {Definition::SolidAngle, Truth::SolidAngle}};
    for (const auto& [shown, truth] : pairs) {
        scene.images().begin()->second = scene.cells().truths().at(truth, 2).visibility;
        for (const auto& [definition, other] : pairs) {
            const Record record = scene.scored(scene.row(definition, false));
            EXPECT_EQ(record.reference->oracle, name(other));
            EXPECT_EQ(*record.values["accuracy.rmse"] == 0, definition == shown)
                << name(definition) << " of " << name(shown);
        }
    }
}

TEST(ForeignCells, OneFrameIsEnoughForAccuracy) {
    const Record own = underPoint().own("pcf");
    const Record foreign = underPoint().scored(underPoint().row(Definition::Hard, false));
    expectSameScores(own, foreign, {"accuracy."});
    EXPECT_FALSE(foreign.values["stability.flicker.mean"]);
}

TEST(ForeignCells, PixelsAwayFromGeometrysEdgesAreScoredApart) {
    underPoint().own("sm-uniform");
    const Record record = underPoint().scored(underPoint().row(Definition::Hard));
    const double inside = *record.values["off_geometry_edges.pixels"], all = *record.values["accuracy.pixels.labelled"];
    EXPECT_LT(inside, all);
    EXPECT_GT(inside, 0.9 * all);
    ForeignRow row = underPoint().row(Definition::Hard);
    row.leaveOutEdges = true;
    const Record without = underPoint().scored(row);
    EXPECT_EQ(without.values["accuracy.mismatch"], record.values["off_geometry_edges.mismatch"]);
    EXPECT_FALSE(without.values["off_geometry_edges.pixels"]);
}

/// A picture that shows no light where the shadows are wrong hides no error: what it leaves unknown is counted.
TEST(ForeignCells, ReceiversThatAQuotientSaysNothingOfAreSeenOtherwise) {
    underPoint().own("sm-uniform");
    ForeignRow row = underPoint().row(Definition::Hard, false);
    const Record whole = underPoint().scored(row);
    const Image<float>& v = underPoint().images().begin()->second;
    const groundtruth::Reference& truth = underPoint().cells().truths().at(Truth::Hard, 2);
    Image<float> lit(v.width(), v.height(), 1);
    int hidden = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (truth.surface[i] == groundtruth::Surface::Receiver && v[i] != truth.visibility[i]) {
            lit[i] = 0;
            ++hidden;
        }
    ASSERT_GT(hidden, 0);
    writeExr(underPoint().file("lit.exr"), {{"V", &lit}});
    row.frames[0].lit = underPoint().file("lit.exr");
    const Record record = underPoint().scored(row);
    EXPECT_LT(*record.values["accuracy.mismatch"], *whole.values["accuracy.mismatch"]);
    EXPECT_NEAR(*record.values["accuracy.primary_mismatch"] - *whole.values["accuracy.primary_mismatch"],
                hidden / (96.0 * 96), 1e-12);
}

class Refused : public testing::Test {
protected:
    void SetUp() override { underPoint().own("pcf"); }

    /// With what a row is refused whose still image is changed like this.
    template <class Change>
    std::string refusal(Change change) {
        Image<float>& v = underPoint().images().begin()->second;
        v = change(v);
        return refusal(underPoint().row(Definition::Hard));
    }
    std::string refusal(const ForeignRow& row) {
        try {
            underPoint().scored(row);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    }
    static void expectIn(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
    }
};

TEST_F(Refused, AFlippedAShiftedAndABlackImage) {
    const auto changed = [](const Image<float>& v, int dx, bool flip) {
        Image<float> result(v.width(), v.height(), 1);
        for (int y = 0; y < v.height(); ++y)
            for (int x = 0; x < v.width(); ++x)
                if (v.contains(x - dx, y)) result(x, y) = v(x - dx, flip ? v.height() - 1 - y : y);
        return result;
    };
    const Image<float> right = underPoint().images().begin()->second;
    expectIn(refusal([&](const Image<float>&) { return changed(right, 0, true); }),
             "looks upside down: mismatch falls from");
    expectIn(refusal([&](const Image<float>&) { return changed(right, 1, false); }), "looks shifted by (1, 0) pixels");
    expectIn(refusal([&](const Image<float>&) { return Image<float>(96, 96, 0); }), "is black");
    ForeignRow row = underPoint().row(Definition::Hard);
    row.force = true;
    EXPECT_EQ(refusal(row), "");
    ASSERT_EQ(underPoint().warnings().size(), 1U);
    expectIn(underPoint().scored(row).reason, "frame 2 is black");
}

TEST_F(Refused, FramesThatAreNotScoredAndMeaningsThatTheLightHasNot) {
    ForeignRow row = underPoint().row(Definition::Hard);
    row.definition = Definition::Area;
    expectIn(refusal(row), "scene moving has a light of kind point, of which images mean hard, not area");
    row = underPoint().row(Definition::Hard);
    row.frames.pop_back();
    expectIn(refusal(row), "is scored on frame 2, or on all of 2, 3, 4, in this order");
    row = underPoint().row(Definition::Hard);
    row.id = "My Engine";
    expectIn(refusal(row), "is no name for a row");
    row = underPoint().row(Definition::Hard);
    std::swap(row.frames[1].image, row.frames[0].image);
    EXPECT_NE(refusal(row), "");
}

TEST_F(Refused, ADepthOfAnotherCamera) {
    SceneFrames& frames = underPoint().cells().frames();
    frames.show(2);
    const Camera& camera = frames.scene().camera;
    const glm::dvec3 forward = camera.basis().forward;
    Image<float> z(96, 96), distance(96, 96);
    for (std::size_t i = 0; i < z.size(); ++i) {
        if (frames.drawn().id[i] == 0) continue;
        const glm::dvec3 ray = glm::dvec3(frames.drawn().position[i]) - camera.eye;
        z[i] = static_cast<float>(glm::dot(ray, forward));
        distance[i] = static_cast<float>(glm::length(ray));
    }
    writeExr(underPoint().file("z.exr"), {{"Z", &z}});
    writeExr(underPoint().file("distance.exr"), {{"Z", &distance}});
    ForeignRow row = underPoint().row(Definition::Hard, false);
    const Record without = underPoint().scored(row);
    row.frames[0].depth = underPoint().file("z.exr");
    const Record with = underPoint().scored(row);
    EXPECT_EQ(with.values["accuracy.mismatch"], without.values["accuracy.mismatch"]);
    EXPECT_EQ(with.values["accuracy.primary_mismatch"], without.values["accuracy.primary_mismatch"]);
    EXPECT_EQ(with.values["off_geometry_edges.pixels"], without.values["off_geometry_edges.pixels"]);
    row.depth = Depth::FromEye;
    expectIn(refusal(row), "shows another geometry than frame 2 has at");
    row.frames[0].depth = underPoint().file("distance.exr");
    EXPECT_EQ(refusal(row), "");
}

} // namespace
} // namespace shadowbench::foreign
