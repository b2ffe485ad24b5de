// What is said of a metric: the columns of the table in table.h.
#pragma once

#include <any>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace shadowbench::metrics {

/// What a metric is about. Changes of different classes are never weighed against each other.
enum class Class {
    Labels,       // lit or shadowed, both kinds of error together
    FalseShadow,  // acne, too much shadow
    Leak,         // light where there is none
    Edge,         // where the shadow's edge lies
    Penumbra,     // graded visibility
    Flicker,      // stability over time
    Colour,       // of levels of detail, against the finest
    BreakPoint,   // stability over parameters
    Work,         // cost: what is drawn and held, the same on every machine
    Instructions, // cost, the same in every run
    Shader,       // cost of a shader's machine code, the same in every run
    Time,         // cost, measured in pairs of frames
    Figure,       // numbers that only the technique knows
    Status,       // a cell that is no longer scored, or no longer there
};
std::string_view name(Class c);

/// The values that a metric can have.
struct Range {
    double least, most;
    bool whole = false;
};
namespace range {
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Range any{-infinity, infinity}, share{0, 1}, size{0, infinity}, count{0, infinity, true},
    frameNumber{1, infinity, true}, correlation{-1, 1};
} // namespace range

/// How far a metric that is compared with the truth's fractions inherits the truth's own error: not at all, as a mean of
/// differences, or as a root of mean squares.
enum class TruthError { None, Mean, Rms };

/// What a value that is absent from a record with others of its group stands for: nothing, as good as `best`, or a frame
/// after the last still one.
enum class Absent { Nothing, Best, AfterTheEnd };

/// How much of a change from one commit to the next means nothing.
struct Allowance {
    TruthError truth = TruthError::None;
    double pixels = 0;      // so many pixels may change …
    std::string_view of{};  // … of the class whose size this metric is; "": of the image
    double relative = 0;    // so may this share of the former value
    double absolute = 0;    // so may this much, in the metric's unit
    bool magnitude = false; // the distance from 0 counts, and a sign that turns
    double best = 0;        // the value of no error: what is compared is the distance from it
    Absent absent = Absent::Nothing;
};

/// What a function has computed of one `Frame`, kept for the metrics that are parts of it: each function runs once.
template <class Frame>
class Results {
public:
    explicit Results(const Frame& frame) : frame_(frame) {}

    [[nodiscard]] const Frame& frame() const { return frame_; }

    template <class Result>
    const Result& of(Result (*function)(const Frame&)) {
        std::any& result = results_[reinterpret_cast<void (*)()>(function)];
        if (!result.has_value()) result = function(frame_);
        return *std::any_cast<Result>(&result);
    }

private:
    const Frame& frame_;
    std::map<void (*)(), std::any, std::less<>> results_;
};

template <class Frame>
using Value = std::optional<double> (*)(Results<Frame>&);

inline std::optional<double> number(double value) { return value; }
template <class T>
std::optional<double> number(const std::optional<T>& value) {
    return value ? std::optional<double>(static_cast<double>(*value)) : std::nullopt;
}

/// What `function` returns, as a metric's value.
template <auto function, class Frame>
std::optional<double> of(Results<Frame>& results) {
    return number(function(results.frame()));
}

/// One member of what `function` returns, which other metrics have other members of.
template <auto function, auto member, class Frame>
std::optional<double> part(Results<Frame>& results) {
    const auto& result = results.of(function);
    if constexpr (requires { result.has_value(); })
        return result ? number((*result).*member) : std::nullopt;
    else
        return number(result.*member);
}

// What metrics are computed from; frames.h says what each holds.
struct ScoredFrame;
struct ShadedFrame;
struct MappedFrame;
struct StillFrames;
struct MovingFrames;
struct SeedFrames;
struct Walk;

// How a metric comes by its value: the harness computes all that are of one kind in one call (`compute` in values.h).

/// The harness counts or times it, or sets it with what it renders.
struct Measured {};

/// Of the last still frame against exact labels.
struct OfLabels {
    Value<ScoredFrame> value;
};

/// Of the last still frame against graded visibility.
struct OfVisibility {
    Value<ScoredFrame> value;
};

/// Of the last still frame against the truth of pixel areas, under point and directional lights.
struct OfPixelAreas {
    Value<ScoredFrame> value;
};

/// Of the last still frame as a shaded picture, beside the same with the true shadows.
struct OfPicture {
    Value<ShadedFrame> value;
};

/// Of the last still frame and the technique's map.
struct OfMap {
    Value<MappedFrame> value;
};

/// Of all still frames, from an empty history.
struct OfStillFrames {
    Value<StillFrames> value;
};

/// Of the moving frames.
struct OfMovingFrames {
    Value<MovingFrames> value;
};

/// Of the moving frames against what is true of whole pixels: the truth of pixel areas, for soft answers the soft one.
struct OfMovingAreas {
    Value<MovingFrames> value;
};

/// Of the last still frame by several seeds, against graded visibility.
struct OfSeeds {
    Value<SeedFrames> value;
};

/// Of the pictures of a level-of-detail technique.
struct OfWalk {
    Value<Walk> value;
};

/// A list: of each still frame against exact labels.
struct LabelsByFrame {
    Value<ScoredFrame> value;
};

/// A list: of each still frame against graded visibility.
struct VisibilityByFrame {
    Value<ScoredFrame> value;
};

/// A list: of all still frames, from an empty history.
struct ByStillFrame {
    std::vector<double> (*values)(const StillFrames&);
};

using Computation =
    std::variant<Measured, OfLabels, OfVisibility, OfPixelAreas, OfPicture, OfMap, OfStillFrames, OfMovingFrames,
                 OfMovingAreas, OfSeeds, OfWalk, LabelsByFrame, VisibilityByFrame, ByStillFrame>;

/// A line of the table.
struct Metric {
    std::string_view path;                // in the record: its keys, joined by dots
    std::string_view unit;                // "share", "pixels", "ms" …; "1" for visibility and colours, which are in [0, 1]
    Range range = range::any;             // of the value, or of each number of a list
    bool list = false;                    // a number a frame
    bool optional = false;                // may be absent where the rest of its object is there
    bool noisy = false;                   // another run gives another value
    std::optional<Class> about{};         // of a metric that is judged
    std::string_view bound{};             // its name in `[tolerance]`, `[expect]` and the gate's bounds; "": it takes none
    std::optional<Allowance> allowance{}; // of a metric that is compared from commit to commit; smaller is better
    std::string_view notCompared{};       // of one that is not: why
    Computation computed = Measured{};
    std::string_view meaning;
};

} // namespace shadowbench::metrics
