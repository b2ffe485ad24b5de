// Figures for papers: what is enlarged, where things lie, and the files.
#include "site/figure/figure.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "site/figure/figure_files.h"
#include "site/figure/figure_svg.h"
#include "tests/support/message_of.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

constexpr int width = 64, height = 32;

/// All receiver but the last row; lit to the left of column 32.
KeptTruth halfLit() {
    KeptTruth truth{Image<float>(width, height), Image<float>(width, height), Image<float>(width, height, 2),
                    Image<float>(width, height), Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x) truth.visibility(x, y) = 1;
    for (int x = 0; x < width; ++x) truth.surface(x, height - 1) = 0;
    return truth;
}

/// The truth with `value` in a part.
Image<float> with(float value, const Inset& part, Image<float> image = halfLit().visibility) {
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x) image(x, y) = value;
    return image;
}

bool holds(const Inset& outer, const Inset& inner) {
    return outer.x <= inner.x && outer.y <= inner.y && outer.x + outer.width >= inner.x + inner.width &&
           outer.y + outer.height >= inner.y + inner.height;
}

TEST(Inset, IsReadAsItIsWrittenAndElseRefused) {
    EXPECT_EQ(insetOf("12,8,20,10"), (Inset{12, 8, 20, 10}));
    EXPECT_EQ(textOf({12, 8, 20, 10}), "12,8,20,10");
    for (const char* wrong : {"", "1,2,3", "1,2,3,4,5", "1,2,0,4", "a,b,c,d", "1,2,3,4x"})
        EXPECT_NE(test::messageOf([&] { insetOf(wrong); }).find("such as --inset"), std::string::npos) << wrong;
}

TEST(MostTelling, IsWhereTechniquesDifferAndNotWhereAllErrAlike) {
    const Inset shared{4, 4, 10, 4}, own{45, 20, 4, 3};
    const Image<float> one = with(0, shared), two = with(1, own, one);
    EXPECT_TRUE(holds(mostTelling({one, two}, halfLit()), own));
    EXPECT_TRUE(holds(mostTelling({two, one}, halfLit()), own));
    EXPECT_TRUE(holds(mostTelling({one}, halfLit()), shared)) << "of one technique where it errs";
}

TEST(MostTelling, LooksAtReceiversAlone) {
    const Inset outside{0, height - 1, 30, 1}, seen{50, 10, 2, 2};
    const Image<float> one = halfLit().visibility, two = with(1, seen, with(0, outside));
    EXPECT_TRUE(holds(mostTelling({one, two}, halfLit()), seen));
}

TEST(MostTelling, IsTheMiddleWhereNothingDiffers) {
    const Image<float> exact = halfLit().visibility;
    EXPECT_EQ(mostTelling({exact, exact}, halfLit()), (Inset{26, 14, 12, 4}));
}

TEST(Wrapped, BreaksWordsAndCutsWhatHasNoRoom) {
    using Lines = std::vector<std::string>;
    EXPECT_EQ(wrapped("pcf", 10, 2), Lines{"pcf"});
    EXPECT_EQ(wrapped("one two three", 8, 2), (Lines{"one two ", "three"}));
    EXPECT_EQ(wrapped("pcss:taps=32+32,map=2048", 18, 2), (Lines{"pcss:taps=32+32,", "map=2048"}));
    EXPECT_EQ(wrapped("abcdefghij", 4, 2), (Lines{"abcd", "efgh…"}));
    EXPECT_EQ(wrapped("äöüß", 2, 2), (Lines{"äö", "üß"})) << "letters, not bytes";
}

/// A run of three rows on one scene, in a folder.
class Figures : public testing::Test {
protected:
    Figures() {
        const KeptTruth truth = halfLit();
        const fs::path place = folder_.path() / "scene";
        writeExr(place / "truth-hard.exr", {{"V", &truth.visibility},
                                            {"sigma", &truth.sigma},
                                            {"surface", &truth.surface},
                                            {"edge", &truth.edgeDistance},
                                            {"id", &truth.id}});
        keepShading(place / "shading.exr",
                    {Image<glm::vec3>(width, height, glm::vec3(0.2F, 0.1F, 0.05F)), Image<float>(width, height, 4)});
        add("pcf", 0.02, with(0, {8, 8, 4, 4}));
        add("sm-uniform", 0.01, with(1, {40, 16, 8, 8}));
        add("vsm", 0.03, with(0.5F, {8, 8, 4, 4}));
    }

    void add(const std::string& variant, double error, const Image<float>& v) {
        records_.push_back(test::hardCell(variant, error, 1));
        records_.back().scene = "scene";
        records_.back().softReference.reset();
        writeExr(cellFolder(folder_.path(), "scene", variant) / "visibility.exr", {{"V", &v}});
    }

    [[nodiscard]] Figure figure(FigureRequest request = {"scene", {"pcf", "sm-uniform"}, {{40, 16, 8, 8}}}) const {
        return figureOf(request, records_, folder_.path());
    }

    [[nodiscard]] std::string refusal(const FigureRequest& request) const {
        return test::messageOf([&] { return figure(request); });
    }

    TemporaryFolder folder_;
    std::vector<Record> records_;
};

TEST_F(Figures, NameTechniquesForPeopleAndMarkTheBest) {
    const Figure made = figure({"scene", {"vsm", "sm-uniform", "pcf"}});
    ASSERT_EQ(made.columns.size(), 3U);
    EXPECT_EQ(made.columns[0].title, "Variance shadow map");
    EXPECT_EQ(made.columns[0].variant, "vsm");
    EXPECT_EQ(made.columns[1].error, "1.00 %");
    EXPECT_EQ(made.metric, "mismatch");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(made.columns[i].best, i == 1) << i;
    EXPECT_FALSE(figure({"scene", {"pcf"}}).columns[0].best) << "there is nothing that it is better than";
}

TEST_F(Figures, ScaleErrorsSoThatTheyAreSeen) {
    EXPECT_EQ(figure().gain, 1);
    EXPECT_EQ(figure({"scene", {"vsm"}}).gain, 1);
    add("esm", 0.01, with(0.8F, {8, 8, 4, 4}));
    EXPECT_EQ(figure({"scene", {"esm"}}).gain, 4);
    EXPECT_EQ(figure({"scene", {"esm", "pcf"}}).gain, 1);
}

/// Colours of a PNG at a place of the drawing.
class Shown {
public:
    Shown(const fs::path& file, double pixelsPerUnit) : scale_(pixelsPerUnit) {
        for (int i = 0; i < 3; ++i) channels_.push_back(readChannel(file, i));
    }

    [[nodiscard]] glm::vec3 at(double x, double y) const {
        const auto pixel = [&](double place) { return static_cast<int>(place * scale_); };
        glm::vec3 colour;
        for (int i = 0; i < 3; ++i) colour[i] = 255 * channels_[static_cast<std::size_t>(i)](pixel(x), pixel(y));
        return colour;
    }

    /// In a place, at a share of its width and height.
    [[nodiscard]] glm::vec3 in(const Place& place, double x, double y) const {
        return at(place.x + x * place.width, place.y + y * place.height);
    }

    [[nodiscard]] int width() const { return channels_[0].width(); }

private:
    double scale_;
    std::vector<Image<float>> channels_;
};

void expectNear(const glm::vec3& shown, const glm::vec3& wanted, const char* what) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], wanted[i], 2) << what << ", colour " << i;
}

TEST_F(Figures, HaveBoxesInsetsAndErrorsInTheirPlaces) {
    const Figure made = figure();
    const FigureLayout layout(made);
    const fs::path file = folder_.path() / "figure.png";
    writeFigure(made, file);
    const Shown shown(file, layout.pixelsPerUnit());
    EXPECT_EQ(shown.width(), std::lround(layout.width() * layout.pixelsPerUnit()));

    const glm::vec3 white(255), black(0), green(0, 168, 120), blue(80, 170, 255), orange(255, 150, 40), none(24);
    // Column 0 is the truth, 1 pcf with false shadow outside of the inset, 2 sm-uniform with a leak that fills it.
    expectNear(shown.in(layout.picture(0), 0.25, 0.25), white, "lit");
    expectNear(shown.in(layout.picture(0), 0.9, 0.25), black, "in shadow");
    expectNear(shown.in(layout.picture(1), 10.0 / width, 10.0 / height), black, "false shadow");
    for (std::size_t column = 0; column < 3; ++column) {
        const Place box = layout.box(column, 0);
        EXPECT_DOUBLE_EQ(box.x, layout.picture(column).x + 40 * 4);
        EXPECT_DOUBLE_EQ(box.width, 8 * 4);
        expectNear(shown.at(box.x, box.y + 0.5 * box.height), green, "the box's left side");
        expectNear(shown.at(box.x + box.width, box.y + 0.5 * box.height), green, "its right side");
        expectNear(shown.in(layout.inset(column, 0), 0.5, 0.5), column == 2 ? white : black, "the inset");
    }
    expectNear(shown.in(layout.error(1), 10.0 / width, 10.0 / height), orange, "false shadow");
    expectNear(shown.in(layout.error(2), 44.0 / width, 20.0 / height), blue, "leak");
    expectNear(shown.in(layout.error(2), 10.0 / width, 10.0 / height), none, "no error");
    expectNear(shown.in(layout.error(2), 0.5, 31.5 / height), glm::vec3(107), "not scored");
}

TEST_F(Figures, ShowTheSceneShadedIfAsked) {
    const Figure made = figure({"scene", {"pcf"}, {}, true});
    const fs::path file = folder_.path() / "figure.png";
    writeFigure(made, file);
    const FigureLayout layout(made);
    const Shown shown(file, layout.pixelsPerUnit());
    const auto colour = [](const glm::vec3& linear) {
        return 255.0F * shadedPicture({Image<glm::vec3>(1, 1, linear), Image<float>(1, 1)}, Image<float>(1, 1))(0, 0);
    };
    expectNear(shown.in(layout.picture(0), 0.1, 0.1), colour({1, 0.5F, 0.25F}), "lit");
    expectNear(shown.in(layout.picture(0), 0.9, 0.1), colour({0.2F, 0.1F, 0.05F}), "in shadow");
}

TEST_F(Figures, AreTheSameBytesTwice) {
    for (const char* name : {"a.pdf", "a.png", "a.svg"}) {
        std::vector<std::string> before;
        for (const fs::path& file : writeFigure(figure(), folder_.path() / name)) before.push_back(readFile(file));
        std::vector<std::string> again;
        for (const fs::path& file : writeFigure(figure(), folder_.path() / name)) again.push_back(readFile(file));
        EXPECT_EQ(before, again) << name;
        EXPECT_EQ(before.size(), std::string(name) == "a.pdf" ? 2U : 1U) << name;
    }
}

TEST_F(Figures, HaveALatexFileWithCaptionLabelAndTheBestInBold) {
    writeFigure(figure(), folder_.path() / "soft_shadows.pdf");
    const std::string latex = readFile(folder_.path() / "soft_shadows.tex");
    for (const char* part : {"\\begin{figure}", "\\includegraphics[width=\\linewidth]{soft_shadows.pdf}", "\\caption{",
                             "\\label{fig:soft_shadows}", "\\end{figure}", "\\textbf{1.00 \\%}", "2.00 \\%"})
        EXPECT_NE(latex.find(part), std::string::npos) << part << "\n" << latex;
    EXPECT_EQ(latex.find("\\textbf{2.00"), std::string::npos);
}

TEST_F(Figures, AreRefusedWithTheThingAndTheRemedy) {
    const auto expectIn = [&](const std::string& message, const std::string& part) {
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expectIn(refusal({"scene", {"pfc"}}),
             "no row pfc of scene scene (did you mean \"pcf\"?); theirs are: pcf, sm-uniform, vsm; leave --records out");
    expectIn(refusal({"scenes", {"pcf"}}), "no row of scene scenes (did you mean \"scene\"?)");
    expectIn(refusal({"scene", {"pcf"}, {{60, 0, 8, 8}}}), "60,0,8,8 does not lie within the image of 64 × 32");
    expectIn(refusal({"scene", {"pcf"}, std::vector<Inset>(4, {0, 0, 8, 8})}), "room for 3 insets, not for 4");
    expectIn(test::messageOf([&] { writeFigure(figure(), "figure.jpeg"); }), "end with .pdf, .png or .svg");

    fs::remove(folder_.path() / "scene/shading.exr");
    expectIn(refusal({"scene", {"pcf"}, {}, true}), "run it again, or leave --shaded out");
    const Image<float> small(8, 8);
    writeExr(cellFolder(folder_.path(), "scene", "pcf") / "visibility.exr", {{"V", &small}});
    expectIn(refusal({"scene", {"pcf"}}), "no image of 64 × 32 pixels");
    records_[0].status = Status::NotApplicable;
    records_[0].reason = "needs an area light";
    expectIn(refusal({"scene", {"pcf"}}), "needs an area light");
    fs::remove(folder_.path() / "scene/truth-hard.exr");
    expectIn(refusal({"scene", {"vsm"}}), "holds no images of scene scene");
}

TEST_F(Figures, ShowNamesOfStrangersAsText) {
    Figure made = figure();
    made.columns[0].title = made.columns[0].variant = "</text><script>&\n\x01";
    const std::string svg = svgOf(made);
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_NE(svg.find("&lt;/text>&lt;script>&amp;  "), std::string::npos);
}

} // namespace
} // namespace shadowbench::site
