#include "harness/measure/changed_cost.h"

#include "harness/measure/costs.h"
#include "harness/measure/rounds.h"
#include "harness/measure/statistics.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <tuple>

namespace shadowbench::timing {
namespace {

// Two frames of the technique are drawn for each that is timed. One round is enough of a frame that takes longer than the
// budget: so long a time varies little.
constexpr TimingLimits motionLimits{.minimumRounds = 1, .maximumRounds = 25, .budgetSeconds = 0.15};

/// What the stage shows, after a frame in which light and casters were elsewhere.
class Alternation {
public:
    Alternation(Stage& stage, Casters casters, Sequence& frames)
        : stage_(stage), frames_(frames), standing_(stage.shown()), away_(displaced(standing_, casters)),
          back_(returned(standing_, casters)) {}

    /// The technique draws the displaced frame; the stage then shows the one that is measured.
    void leaveAndReturn() {
        stage_.show(away_);
        stage_.render(frames_.technique, frames_.index++, frames_.seed);
        stage_.show(back_);
    }

    /// The stage shows again what it showed.
    void stand() { stage_.show(standing_); }

private:
    Stage& stage_;
    Sequence& frames_;
    Snapshot standing_, away_, back_;
};

bool drawTheSame(const std::vector<PassRecord>& a, const std::vector<PassRecord>& b) {
    return std::ranges::equal(a, b, [](const PassRecord& x, const PassRecord& y) {
        return std::tie(x.name, x.runs, x.vertices, x.draws) == std::tie(y.name, y.runs, y.vertices, y.draws);
    });
}

void countMotion(Stage& stage, Sequence& frames, Record& record) {
    const FramePasses passes = countPasses(framesOf(stage, frames));
    setWork(record, WorkOf::MovingFrame, passes.frame().work);
    record.motionPasses = passRecords(passes, false);
}

} // namespace

void measureMotionWork(Stage& stage, Casters casters, Sequence& frames, Record& record) {
    Alternation alternation(stage, casters, frames);
    alternation.leaveAndReturn();
    countMotion(stage, frames, record);
    alternation.stand();
}

void measureFirstAndMotionWork(Stage& stage, Casters casters, Sequence& frames, Record& record) {
    const Snapshot standing = stage.shown();
    Sequence away = frames;
    stage.show(displaced(standing, casters));
    measureFirstWork(stage, away, record);
    stage.show(returned(standing, casters));
    countMotion(stage, frames, record);
}

void measureMotionTime(Stage& stage, Casters casters, Sequence& frames, Record& record) {
    Alternation alternation(stage, casters, frames);
    const techniques::Variant uniformVariant = techniques::parseVariant("sm-uniform");
    const auto uniformMap = uniformVariant.entry->make(uniformVariant.parameters);
    FramePasses passes;
    const auto timed = [&] { passes = timeOnce(framesOf(stage, frames)); };
    const auto drawn = [&](techniques::Technique& technique, int index) {
        stage.redraw();
        stage.render(technique, index, frames.seed);
    };
    // A frame that is too long to be drawn again is timed pass by pass at once.
    const bool once = wallMilliseconds([&] { alternation.leaveAndReturn(); }) > 1000 * motionLimits.budgetSeconds;
    bool hasReturned = true;
    const auto leaveAndReturn = [&] {
        if (!hasReturned) alternation.leaveAndReturn();
        hasReturned = false;
    };
    Runner own{once ? std::function<void()>(timed) : [&] { drawn(frames.technique, frames.index++); }, leaveAndReturn};
    Runner uniform{[&] { drawn(*uniformMap, frames.index); }};
    uniform.frame(); // warm up
    timeRounds({&own, &uniform}, motionLimits, [] {});
    setTime(record, MotionTime{median(own.samples), median(quotients(own.samples, uniform.samples)), own.samples});
    if (!record.motionPasses.empty()) { // else they are those of the standing frame
        if (!once) {
            leaveAndReturn();
            timed();
        }
        addTimes(passRecords(passes, true), record.motionPasses);
    }
    alternation.stand();
}

void measureFirstWork(Stage& stage, Sequence& frames, Record& record) {
    const FramePasses passes = countPasses(framesOf(stage, frames));
    setWork(record, WorkOf::FirstFrame, passes.frame().work);
    record.coldPasses = passRecords(passes, false);
}

void keepChangedPasses(Record& record) {
    for (std::vector<PassRecord>* passes : {&record.motionPasses, &record.coldPasses})
        if (drawTheSame(*passes, record.passes)) passes->clear();
}

std::unique_ptr<techniques::Technique> measureFirstTime(Stage& stage, const techniques::Variant& variant, int index,
                                                        std::uint32_t seed, Record& record) {
    std::unique_ptr<techniques::Technique> technique;
    const double withCompiling = wallMilliseconds([&] {
        technique = variant.entry->make(variant.parameters);
        stage.redraw();
        stage.render(*technique, index, seed);
    });
    technique->reset();
    Sequence frames{*technique, index, seed};
    FramePasses passes;
    const double frame = wallMilliseconds([&] { passes = timeOnce(framesOf(stage, frames)); });
    setTime(record, ColdTime{frame, std::max(withCompiling - frame, 0.0)});
    if (!record.coldPasses.empty()) addTimes(passRecords(passes, true), record.coldPasses);
    return technique;
}

} // namespace shadowbench::timing
