#include "report/charts.h"
#include "report/costing.h"
#include "report/families.h"
#include "report/gnuplot.h"
#include "report/labels.h"
#include "report/run_report.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

namespace shadowbench::report {
namespace {

constexpr int width = 960, height = 632;
constexpr double left = 96, top = 100, bottom = 552; // of the plot, pixels, y down
constexpr double widest = 936, besideStrip = 700;    // its right side; beside a strip of rows without a place
constexpr std::size_t longestLabel = 60;             // letters
constexpr double widestName = 190;                   // pixels: what fits into the strip
constexpr std::size_t mostNames = 32;                // lines of the strip
constexpr double keyRow = 52, familyRow = 74;        // heights of what explains marks and colours
const char* const ink = "#222222";

/// A row of a renderer whose cost is not measured here, so that it has an error and no place.
struct External {
    std::string variant;
    double error;
    bool adequate;
};

struct Point {
    std::string name; // the variant, and those that it cannot be told from
    Place place;
    const Family* family;
    bool onFront;
    bool adequate;
    bool named; // has a label
};

/// Text of a label: its beginning and "…" where it is a long one.
std::string labelText(const std::string& text) {
    if (text.size() <= longestLabel) return text;
    std::size_t end = longestLabel;
    while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end; // a character stays whole
    return text.substr(0, end) + "…";
}

/// Points on the front first, by cost, so that they get the best places for their labels.
std::vector<Point> points(const std::vector<Record>& records, const std::string& scene, const CostOf& costOf,
                          const std::vector<std::string>& named) {
    const std::vector<std::size_t> front = paretoFront(records, scene, costOf);
    const std::vector<Tolerance> limits = tolerances(records, scene);
    std::vector<std::size_t> order = front;
    for (const std::size_t i : ofScene(records, scene))
        if (place(records[i], costOf) && std::find(front.begin(), front.end(), i) == front.end()) order.push_back(i);

    const auto equals = inseparable(records, scene);
    std::vector<Point> result;
    for (const std::size_t i : order) {
        const Record& record = records[i];
        const std::string name =
            equals.contains(i) ? fmt::format("{} ≈ {}", record.variant, variantsOf(records, equals.at(i))) : record.variant;
        const bool onFront = result.size() < front.size();
        result.push_back({labelText(name), *place(record, costOf), &familyOf(record.technique), onFront,
                          isWithin(record, limits) && !isBaseline(record),
                          onFront || std::ranges::find(named, record.variant) != named.end() ||
                              std::ranges::find(named, record.technique) != named.end()});
    }
    return result;
}

/// The front of a scene that stands still, by cost; empty where that is the only one known.
std::vector<Place> standingFront(const std::vector<Record>& records, const std::string& scene, const CostOf& standing) {
    std::vector<Place> front;
    bool known = false;
    for (const std::size_t i : ofScene(records, scene)) known = known || knowsMotion(records[i]);
    if (known)
        for (const std::size_t i : paretoFront(records, scene, standing)) front.push_back(*place(records[i], standing));
    return front;
}

std::vector<External> externals(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<Tolerance> limits = tolerances(records, scene);
    std::vector<External> result;
    for (const std::size_t i : ofScene(records, scene))
        if (const auto error = headline(records[i]); error && isExternal(records[i]))
            result.push_back({records[i].variant, error->value, isWithin(records[i], limits)});
    return result;
}

class Canvas {
public:
    Canvas(const LogAxis& cost, const LogAxis& error, double right) : cost_(cost), error_(error), right_(right) {}

    [[nodiscard]] double right() const { return right_; }
    [[nodiscard]] double rowOf(double error) const { return bottom - (bottom - top) * error_.position(error); }
    [[nodiscard]] glm::dvec2 at(const Place& place) const {
        return {left + (right_ - left) * cost_.position(place.cost), rowOf(place.error)};
    }
    [[nodiscard]] static std::string screen(glm::dvec2 pixel) {
        return fmt::format("screen {:.5f}, screen {:.5f}", pixel.x / width, 1 - pixel.y / height);
    }
    [[nodiscard]] const LogAxis& cost() const { return cost_; }
    [[nodiscard]] const LogAxis& error() const { return error_; }

private:
    LogAxis cost_, error_;
    double right_;
};

Canvas canvas(const std::vector<Point>& all, const std::vector<Place>& standing, const std::vector<External>& beside,
              const std::optional<Tolerance>& limit) {
    std::vector<double> costs, errors;
    for (const Place& place : standing) costs.push_back(place.cost);
    for (const External& row : beside) errors.push_back(row.error);
    for (const Point& point : all) {
        costs.push_back(point.place.cost);
        errors.push_back(point.place.error);
    }
    if (limit) errors.push_back(limit->value);
    return {LogAxis(costs), LogAxis(errors), beside.empty() ? widest : besideStrip};
}

std::vector<Place> frontOf(const std::vector<Point>& all) {
    std::vector<Place> front;
    for (const Point& point : all)
        if (point.onFront) front.push_back(point.place);
    return front;
}

std::vector<Place> corners(const std::vector<Place>& front, const Canvas& canvas) {
    std::vector<Place> result;
    for (const Place& place : front) {
        result.push_back({result.empty() ? canvas.error().high() : result.back().error, place.cost});
        result.push_back(place);
    }
    if (!result.empty()) result.push_back({result.back().error, canvas.cost().high()});
    return result;
}

std::string block(const std::string& name, const std::vector<Place>& places, const Canvas& canvas) {
    std::string text = fmt::format("${} << EOD\n", name);
    for (const Place& place : places)
        text += fmt::format("{} {}\n", canvas.cost().drawn(place.cost), canvas.error().drawn(place.error));
    return text + "EOD\n";
}

std::string labelScript(const LabelledPoint& point, const PlacedLabel& placed, const char* colour) {
    const Box& box = placed.box;
    const int side = placed.side.x;
    const double x = side > 0 ? box.low.x : side < 0 ? box.high.x : 0.5 * (box.low.x + box.high.x);
    std::string script = fmt::format("set label {} at {} {} front font ',12' textcolor rgb '{}'\n", literal(point.text),
                                     Canvas::screen({x, 0.5 * (box.low.y + box.high.y)}),
                                     side > 0   ? "left"
                                     : side < 0 ? "right"
                                                : "center",
                                     colour);
    if (!placed.leader) return script;
    return script + fmt::format("set arrow from {} to {} nohead lc rgb '#9A9A9A' lw 1\n", Canvas::screen(point.at),
                                Canvas::screen(box.closest(point.at)));
}

/// Where the name of the tolerance's line stands: at its right end, or as near to it as the marks allow.
std::optional<Box> toleranceBox(const std::string& text, double y, double right, const std::vector<glm::dvec2>& marks) {
    const glm::dvec2 size = labelled({}, text).size;
    for (double x = right - 4; x - size.x > left + 4; x -= 12)
        for (const double middle : {y - 9, y + 9}) {
            const Box box{{x - size.x, middle - 0.5 * size.y}, {x, middle + 0.5 * size.y}};
            const auto isNear = [&](glm::dvec2 mark) { return box.overlaps({mark - 7.0, mark + 7.0}); };
            if (std::ranges::none_of(marks, isNear)) return box;
        }
    return {};
}

/// The names of the front and of what the user names, and of the tolerance; the others are dots, which the table below the
/// chart lists.
std::string labels(const std::vector<Point>& all, const std::vector<Place>& standing, const Canvas& canvas,
                   const std::optional<Tolerance>& limit) {
    Surroundings around{.area = {{left + 4, top}, {canvas.right(), bottom - 2}}, .marks = {}};
    std::vector<LabelledPoint> named;
    for (const Point& point : all) {
        around.marks.push_back(canvas.at(point.place));
        if (point.named) named.push_back(labelled(around.marks.back(), point.name));
    }
    for (const std::vector<Place>& front : {corners(frontOf(all), canvas), corners(standing, canvas)})
        for (std::size_t i = 1; i < front.size(); ++i)
            around.lines.emplace_back(canvas.at(front[i - 1]), canvas.at(front[i]));
    std::string script;
    if (limit) {
        const double y = canvas.rowOf(limit->value);
        const std::string text = "tolerance " + formatBound(*limit);
        around.lines.emplace_back(glm::dvec2(left, y), glm::dvec2(canvas.right(), y));
        if (const std::optional<Box> box = toleranceBox(text, y, canvas.right(), around.marks)) {
            around.taken.push_back(*box);
            script += labelScript({{}, text, {}}, {*box, {-1, 0}, false}, vermilion);
        }
    }
    const std::vector<std::optional<PlacedLabel>> placed = placeLabels(named, around);
    for (std::size_t i = 0; i < placed.size(); ++i)
        if (placed[i]) script += labelScript(named[i], *placed[i], ink);
    return script;
}

/// The rows without a cost, by their errors alone, in a strip of their own right of the plot: a mark each, and the names of
/// as many as can be read there, those of least error.
std::string strip(std::vector<External> rows, const Canvas& canvas) {
    if (rows.empty()) return "";
    const double x = canvas.right() + 24;
    const auto text = [&](const std::string& words, double y) {
        return fmt::format("set label {} at {} left font ',12'\n", literal(words), Canvas::screen({x - 8, y}));
    };
    std::string script = text("cost not measured here:", top - 24);
    std::ranges::stable_sort(rows, {}, &External::error);
    std::vector<LabelledPoint> named;
    for (const External& row : rows) {
        std::string name = row.variant.substr(externalPrefix.size());
        while (textWidth(name, labelSize) > widestName) name.pop_back();
        named.push_back(labelled({x, canvas.rowOf(row.error)}, name));
        script += fmt::format("set label '' at {} point pt {} ps 1.2 lw 2 lc rgb '{}'\n", Canvas::screen(named.back().at),
                              row.adequate ? 13 : 12, familyOf(row.variant).colour);
    }
    named.resize(std::min(named.size(), mostNames));
    const std::size_t unnamed = rows.size() - named.size();
    script += text(unnamed == 0 ? "other renderers" : fmt::format("other renderers ({} not named)", unnamed), top - 8);
    const std::vector<PlacedLabel> placed = placeInColumn(named, {{x + 36, top}, {width - 4, bottom}});
    for (std::size_t i = 0; i < placed.size(); ++i) script += labelScript(named[i], placed[i], ink);
    return script;
}

std::vector<Place> chosen(const std::vector<Point>& all, const Family& family, bool onFront, bool adequate) {
    std::vector<Place> result;
    for (const Point& point : all)
        if (point.family == &family && point.onFront == onFront && point.adequate == adequate) result.push_back(point.place);
    return result;
}

/// Points in their family's colour, those of the front larger and over the others.
std::string plotCommand(const std::vector<Point>& all, const std::vector<Place>& standing, const Canvas& canvas,
                        const std::optional<Tolerance>& limit) {
    std::string data = block("front", corners(frontOf(all), canvas), canvas);
    std::string plots = fmt::format("plot $front with lines lw 2 lc rgb '{}'", ink);
    if (!standing.empty()) {
        data += block("standing", corners(standing, canvas), canvas);
        plots += fmt::format(", $standing with lines lw 1.5 dt 3 lc rgb '{}'", ink);
    }
    if (limit) plots += fmt::format(", {} with lines lw 2 dt 2 lc rgb '{}'", limit->value, vermilion);
    for (const bool onFront : {false, true})
        for (const Family& family : families())
            for (const bool adequate : {true, false}) {
                const std::vector<Place> places = chosen(all, family, onFront, adequate);
                if (places.empty()) continue;
                const std::string name = fmt::format("{}{}{}", family.id, onFront ? 1 : 0, adequate ? 1 : 0);
                data += block(name, places, canvas);
                plots += fmt::format(", ${} with points pt {} ps {} lw 2 lc rgb '{}'", name, adequate ? 7 : 6,
                                     onFront ? 1.3 : 0.9, family.colour);
            }
    return data + plots + "\n";
}

/// A dot and a name for each family of the chart, in lines that end at `right`.
std::string familyKey(const std::vector<Point>& all, bool external, double right) {
    std::string script;
    double x = left, y = familyRow;
    for (const Family& family : families()) {
        const bool isThere = std::ranges::find(all, &family, &Point::family) != all.end();
        if (!isThere && !(external && family.id == std::string_view("external"))) continue;
        const double wide = 12 + textWidth(family.title, labelSize) + 16;
        if (x + wide > right) {
            x = left;
            y += 16;
        }
        script +=
            fmt::format("set label '' at {} point pt 7 ps 0.9 lc rgb '{}'\n", Canvas::screen({x + 5, y}), family.colour);
        script += fmt::format("set label {} at {} left font ',12'\n", literal(family.title), Canvas::screen({x + 14, y}));
        x += wide;
    }
    return script;
}

/// What the dotted line means, right of the title.
std::string standingKey() {
    const double y = 26;
    return fmt::format("set arrow from {} to {} nohead lw 1.5 dt 3 lc rgb '{}'\n", Canvas::screen({widest - 300, y}),
                       Canvas::screen({widest - 272, y}), ink) +
           fmt::format("set label {} at {} left font ',12'\n", literal("front if light and casters stand still"),
                       Canvas::screen({widest - 264, y}));
}

/// What line and points mean, in one row under the title.
std::string key(const std::vector<Tolerance>& limits) {
    const double y = keyRow;
    const auto text = [y](const std::string& words, double x) {
        return fmt::format("set label {} at {} left font ',12'\n", literal(words), Canvas::screen({x, y}));
    };
    const auto point = [y](int kind, double x) {
        return fmt::format("set label '' at {} point pt {} ps 1.1 lw 2 lc rgb '{}'\n", Canvas::screen({x, y}), kind, grey);
    };
    std::string script = fmt::format("set arrow from {} to {} nohead lw 2 lc rgb '{}'\n", Canvas::screen({left, y}),
                                     Canvas::screen({left + 28, y}), ink);
    script += text("Pareto front", left + 36);
    if (limits.empty()) return script;
    std::vector<std::string> bounds;
    for (const Tolerance& limit : limits) bounds.push_back(fmt::format("{} ≤ {}", limit.metric, formatBound(limit)));
    const std::string within = fmt::format("within tolerance ({})", fmt::join(bounds, ", "));
    const double end = 160 + textWidth(within, labelSize) + 24;
    script += point(7, left + 146) + text(within, left + 160);
    return script + point(6, left + end) + text("outside", left + end + 14);
}

std::optional<std::string> chartOf(const std::vector<Record>& records, const std::string& scene, const Costing& costing,
                                   const std::vector<std::string>& named) {
    const std::vector<Point> all = points(records, scene, costing.of, named);
    if (all.empty()) return {};
    const std::vector<Place> standing = standingFront(records, scene, costing.standing);
    const std::string metric = headlineMetric(records, scene);
    const std::vector<Tolerance> limits = tolerances(records, scene);
    const auto found = std::ranges::find(limits, metric, &Tolerance::metric);
    const std::optional<Tolerance> limit = found == limits.end() ? std::nullopt : std::optional(*found);
    const std::vector<External> beside = externals(records, scene);
    const Canvas area = canvas(all, standing, beside, limit);
    const bool share = isShare(metric);

    std::string script = plotArea(left / width, area.right() / width, top, bottom, height);
    script += fmt::format("set label {} at {} left font ',18'\n", literal(scene), Canvas::screen({left, 26}));
    script += "unset key\n" + key(limits) + familyKey(all, !beside.empty(), beside.empty() ? width : area.right());
    if (!standing.empty()) script += standingKey();
    script += fmt::format("set xlabel {}\n", literal("cost: " + costing.meaning));
    script += fmt::format("set ylabel {}\n", literal("error: " + meaning(metric)));
    script += area.cost().script("x", 1, costing.unit == "×" ? costing.unit : "");
    script += area.error().script("y", share ? 100 : 1, share ? " %%" : "");
    script += labels(all, standing, area, limit);
    script += strip(beside, area);
    script += plotCommand(all, standing, area, limit);
    return svgOf(script, width, height);
}

} // namespace

std::optional<std::string> paretoChart(const std::vector<Record>& records, const std::string& scene,
                                       const std::vector<std::string>& named) {
    return chartOf(records, scene, measuredHere(records, scene), named);
}

std::optional<std::string> modelledChart(const std::vector<Record>& records, const std::string& scene, const std::string& on,
                                         const std::vector<std::string>& named) {
    return chartOf(records, scene, modelledOn(on), named);
}

} // namespace shadowbench::report
